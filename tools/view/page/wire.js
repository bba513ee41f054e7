// Decodes the binary messages of `mocap view`. Little-endian, like all machines that run browsers.

/** Names of the states, by their number in a pose message. */
export const STATES = ['searching', 'acquiring', 'tracking', 'lost', 'bridged'];
export const BRIDGED = STATES.indexOf('bridged');  // Only in takes that were solved.

export const POSE = 1;
export const VOXELS = 2;
export const PICTURE = 3;
export const KEYPOINTS = 4;

const POSE_HEADER_BYTES = 316;
const CAPSULE_FLOATS = 8;
const VOXELS_HEADER_BYTES = 32;
const PICTURE_HEADER_BYTES = 32;
const KEYPOINTS_HEADER_BYTES = 16;
const KEYPOINT_FLOATS = 4;  // landmark, x, y, score
const POINT_COUNT = 23;
const DOUBT_BYTES = 12;  // id and probabilities
const CONTACT_FLOATS = 4;  // place and probability
const CONTACT_COUNT = 4;
const CONTACTS_BYTES = 4 * CONTACT_FLOATS * CONTACT_COUNT;
const POINTS_BYTES = 4 * 3 * POINT_COUNT;
const LINE_SIDES = 4;

function require(buffer, end) {
  if (end > buffer.byteLength) {
    throw new RangeError(`message ends at ${buffer.byteLength}, wants ${end} bytes`);
  }
}

function floats(buffer, begin, count) {
  return new Float32Array(buffer.slice(begin, begin + 4 * count));
}

/** @return {number} the kind of the message at `begin`, 0 if there is none. */
export function kindOf(buffer, begin = 0) {
  return buffer.byteLength > begin ? new Uint8Array(buffer, begin, 1)[0] : 0;
}

/**
 * Decodes the pose at `begin`; `end` is the start of the next message. The probability is NaN if it
 * is not known; `rival` is the likeliest other pose, or null. `contacts` has x, y, z [mm] and
 * probability of each heel and toe; NaN if they are not known.
 */
export function decodePose(buffer, begin = 0) {
  require(buffer, begin + POSE_HEADER_BYTES);
  const view = new DataView(buffer, begin);
  const capsuleCount = view.getUint16(6, true);
  const idAt = POSE_HEADER_BYTES + 4 * CAPSULE_FLOATS * capsuleCount;
  const rivalAt = begin + idAt + DOUBT_BYTES;
  require(buffer, rivalAt);
  const rivalProbability = view.getFloat32(idAt + 8, true);
  const contactsAt = rivalAt + (rivalProbability > 0 ? POINTS_BYTES : 0);
  const end = contactsAt + CONTACTS_BYTES;
  require(buffer, end);
  return {
    person: view.getUint8(1),
    id: view.getUint32(idAt, true),
    state: STATES[view.getUint8(2)] ?? 'searching',
    hasPose: view.getUint8(3) !== 0,
    timeMs: view.getFloat64(8, true),
    publishMs: view.getFloat64(16, true),
    frame: view.getFloat64(24, true),
    residualMm: view.getFloat32(32, true),
    voxels: view.getUint32(36, true),
    points: floats(buffer, begin + 40, 3 * POINT_COUNT),
    capsules: floats(buffer, begin + POSE_HEADER_BYTES, CAPSULE_FLOATS * capsuleCount),
    probability: view.getFloat32(idAt + 4, true),
    rival: rivalProbability > 0 ?
        {probability: rivalProbability, points: floats(buffer, rivalAt, 3 * POINT_COUNT)} :
        null,
    contacts: floats(buffer, contactsAt, CONTACT_FLOATS * CONTACT_COUNT),
    end,
  };
}

/** Decodes surface voxels: `cells` has x, y, z and part of each; part 65535 means none. */
export function decodeVoxels(buffer, begin = 0) {
  require(buffer, begin + VOXELS_HEADER_BYTES);
  const view = new DataView(buffer, begin);
  const count = view.getUint32(4, true);
  const end = begin + VOXELS_HEADER_BYTES + 8 * count;
  require(buffer, end);
  return {
    person: view.getUint8(1),
    count,
    timeMs: view.getFloat64(8, true),
    sizeMm: view.getFloat32(16, true),
    originMm: [20, 24, 28].map((at) => view.getFloat32(at, true)),
    cells: new Uint16Array(buffer, begin + VOXELS_HEADER_BYTES, 4 * count),
    end,
  };
}

/**
 * Splits `{n, class, x0, y0, …}` sequences into lines; ignores a truncated one. A line's person is
 * null for a single person.
 */
export function splitLines(values) {
  const lines = [];
  for (let at = 0; at + 2 <= values.length;) {
    const count = values[at];
    const end = at + 2 + 2 * count;
    if (!(count >= 1) || end > values.length) break;
    const kind = values[at + 1];
    const person = kind < LINE_SIDES ? null : Math.floor(kind / LINE_SIDES) - 1;
    lines.push({side: kind % LINE_SIDES, person, points: values.subarray(at + 2, end)});
    at = end;
  }
  return lines;
}

/** Decodes the picture at `begin`; `end` is the start of the next message. */
export function decodePicture(buffer, begin = 0) {
  require(buffer, begin + PICTURE_HEADER_BYTES);
  const view = new DataView(buffer, begin);
  const trimapFloats = view.getUint32(16, true);
  const bodyFloats = view.getUint32(20, true);
  const jpegBytes = view.getUint32(24, true);
  const trimap = begin + PICTURE_HEADER_BYTES;
  const body = trimap + 4 * trimapFloats;
  const jpeg = body + 4 * bodyFloats;
  require(buffer, jpeg + jpegBytes);
  const trimapLines = splitLines(floats(buffer, trimap, trimapFloats));
  return {
    camera: view.getUint8(1),
    widthPx: view.getUint16(2, true),
    heightPx: view.getUint16(4, true),
    timeMs: view.getFloat64(8, true),
    silhouette: trimapLines.filter((line) => line.side === 0),
    unknownShare: view.getFloat32(28, true),
    unknown: trimapLines.filter((line) => line.side === 1),
    body: splitLines(floats(buffer, body, bodyFloats)),
    jpeg: new Uint8Array(buffer, jpeg, jpegBytes),
    end: begin + 8 * Math.ceil((jpeg + jpegBytes - begin) / 8),
  };
}

/** Decodes the keypoints of one person: `points` has landmark, x, y [px] and score of each. */
export function decodeKeypoints(buffer, begin = 0) {
  require(buffer, begin + KEYPOINTS_HEADER_BYTES);
  const view = new DataView(buffer, begin);
  const count = KEYPOINT_FLOATS * view.getUint16(2, true);
  const end = begin + KEYPOINTS_HEADER_BYTES + 4 * count;
  require(buffer, end);
  return {
    camera: view.getUint8(1),
    person: view.getUint32(4, true),
    timeMs: view.getFloat64(8, true),
    points: floats(buffer, begin + KEYPOINTS_HEADER_BYTES, count),
    end,
  };
}

/** Decodes a picture, keypoints or voxels of a take, by `kind`. */
export function decodeSeen(buffer, begin = 0) {
  const kind = kindOf(buffer, begin);
  const decode = {[VOXELS]: decodeVoxels, [KEYPOINTS]: decodeKeypoints}[kind] ?? decodePicture;
  return {kind, ...decode(buffer, begin)};
}

/** Decodes consecutive messages. */
export function decodeAll(buffer, decode) {
  const messages = [];
  for (let at = 0; at < buffer.byteLength;) {
    const message = decode(buffer, at);
    messages.push(message);
    at = message.end;
  }
  return messages;
}

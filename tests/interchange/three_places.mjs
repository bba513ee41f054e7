// Where three.js puts the joints of a BVH or GLB file, in the file's units and axes (y up).
//
// usage: node three_places.mjs FOLDER FILE SECONDS ...    FOLDER has build/ and examples/jsm/ of three.js
//
// Prints a list of {bone: [x, y, z]}, one for each of the times since the file's time 0.
import { readFileSync } from "node:fs";
import { join } from "node:path";

const [folder, path, ...seconds] = process.argv.slice(2);
const three = await import(join(folder, "build/three.module.js"));

async function read() {
  if (path.endsWith(".bvh")) {
    const { BVHLoader } = await import(join(folder, "examples/jsm/loaders/BVHLoader.js"));
    const { skeleton, clip } = new BVHLoader().parse(readFileSync(path, "utf8"));
    const scene = new three.Group();
    scene.skeleton = skeleton;
    scene.add(skeleton.bones[0]);
    return { scene, clip };
  }
  const { GLTFLoader } = await import(join(folder, "examples/jsm/loaders/GLTFLoader.js"));
  const bytes = readFileSync(path);
  const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length);
  const gltf = await new Promise((done, fail) => new GLTFLoader().parse(buffer, "", done, fail));
  return { scene: gltf.scene, clip: gltf.animations[0] };
}

function placesAt(scene, clip, time) {
  const mixer = new three.AnimationMixer(scene);
  const action = mixer.clipAction(clip);
  action.setLoop(three.LoopOnce);
  action.clampWhenFinished = true;
  action.play();
  mixer.update(time);
  scene.updateMatrixWorld(true);
  const places = {};
  scene.traverse((thing) => {
    // The ends of BVH's limbs have no names of their own.
    const name = thing.name === "ENDSITE" ? `${thing.parent.name}End` : thing.name;
    if (name) places[name] = new three.Vector3().setFromMatrixPosition(thing.matrixWorld).toArray();
  });
  return places;
}

const { scene, clip } = await read();
console.log(JSON.stringify(seconds.map((time) => placesAt(scene, clip, Number(time)))));

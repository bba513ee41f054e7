// A WebSocket that reconnects, with increasing delays of up to ten seconds.

const FIRST_WAIT_MS = 500;
const LONGEST_WAIT_MS = 10000;

export class Socket {
  /** @param handlers open(), text(object), binary(buffer), closed(). */
  constructor(url, handlers) {
    this.url = url;
    this.handlers = handlers;
    this.isOpen = false;
    this.closedMs = performance.now();
    this.waitMs = FIRST_WAIT_MS;
    this.connect();
  }

  connect() {
    const socket = new WebSocket(this.url);
    socket.binaryType = 'arraybuffer';
    socket.addEventListener('open', () => {
      this.isOpen = true;
      this.waitMs = FIRST_WAIT_MS;
      this.handlers.open();
    });
    socket.addEventListener('message', ({data}) => this.take(data));
    socket.addEventListener('close', () => this.closed());
  }

  take(data) {
    if (typeof data !== 'string') return this.handlers.binary(data);
    let message;
    try {
      message = JSON.parse(data);
    } catch {
      return undefined;  // Not a message of this protocol.
    }
    return this.handlers.text(message);
  }

  closed() {
    if (this.isOpen) this.closedMs = performance.now();
    this.isOpen = false;
    this.handlers.closed();
    setTimeout(() => this.connect(), this.waitMs * (0.75 + 0.5 * Math.random()));
    this.waitMs = Math.min(LONGEST_WAIT_MS, 2 * this.waitMs);
  }
}

// The connection to the node. Answers wait in an outbox until the posterior has taken or refused them, so a lost
// connection loses nothing; every answer has an id, so sending it again doubles nothing.

export const PROTOCOL = 1;
const SILENCE_MS = 7000;
const OUTBOX = "apprentice.outbox";

/** A random version 4 UUID; `crypto.randomUUID` is missing on plain http away from loopback. */
export function newId() {
  const b = crypto.getRandomValues(new Uint8Array(16));
  b[6] = (b[6] & 0x0f) | 0x40;
  b[8] = (b[8] & 0x3f) | 0x80;
  const hex = [...b].map((v) => v.toString(16).padStart(2, "0")).join("");
  return [hex.slice(0, 8), hex.slice(8, 12), hex.slice(12, 16), hex.slice(16, 20), hex.slice(20)].join("-");
}

export class Link {
  /** `on` has the callbacks status(word), sections(object), refused(id, reason) and notice(text). */
  constructor(on) {
    this.on = on;
    this.outbox = new Map(load());
    this.delay = 250;
    setInterval(() => this.watch(), 1000);
    addEventListener("online", () => this.open());
    this.open();
  }

  open() {
    if (this.socket && this.socket.readyState <= WebSocket.OPEN) return;
    clearTimeout(this.timer);
    const socket = new WebSocket(`${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/ws`);
    this.socket = socket;
    this.heard = Date.now();
    socket.onopen = () => {
      this.delay = 250;
      for (const command of this.outbox.values()) socket.send(JSON.stringify(command));
    };
    socket.onmessage = (event) => {
      this.heard = Date.now();
      this.receive(JSON.parse(event.data));
    };
    let opened = false;
    socket.addEventListener("open", () => { opened = true; });
    socket.onclose = () => {
      if (socket !== this.socket) return;
      this.on.status("lost");
      if (!opened) this.askWhy();
      this.timer = setTimeout(() => this.open(), this.delay);
      this.delay = Math.min(this.delay * 1.7, 4000);
    };
  }

  /** A socket does not say why it was turned away; a plain request does. */
  async askWhy() {
    const answer = await fetch("icon.svg", { cache: "no-store" }).catch(() => null);
    if (answer && answer.status === 401) this.on.status("expired");
  }

  /** A connection that has gone silent is given up and opened anew. */
  watch() {
    if (this.socket.readyState === WebSocket.OPEN && Date.now() - this.heard > SILENCE_MS) {
      const silent = this.socket;
      this.socket = null;
      silent.onclose = null;
      silent.close();
      this.on.status("lost");
      this.open();
    }
  }

  receive(message) {
    if (message.type === "state") {
      if (message.protocol !== PROTOCOL) return location.reload();
      if (message.sections.answers) this.settle(message.sections.answers);
      this.on.status("open");
      this.on.sections(message.sections);
    } else if (message.type === "refused") {
      if (message.id !== null) this.drop(message.id);
      this.on.refused(message.id, message.reason);
    } else if (message.type === "notice") {
      this.on.notice(message.text);
    }
  }

  send(command) {
    this.outbox.set(command.id, command);
    this.save();
    if (this.socket && this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(command));
  }

  /** Sends a command once: nothing is lost with it. */
  ask(command) {
    if (this.socket && this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(command));
  }

  settle(answers) {
    for (const answer of answers) {
      if (answer.state !== "pending") this.drop(answer.id);
      if (answer.undo && (answer.undo.state === "accepted" || answer.undo.state === "refused")) this.drop(answer.undo.id);
    }
  }

  drop(id) {
    if (this.outbox.delete(id)) this.save();
  }

  save() {
    try { sessionStorage.setItem(OUTBOX, JSON.stringify([...this.outbox])); } catch { /* private mode: memory only */ }
  }
}

function load() {
  try { return JSON.parse(sessionStorage.getItem(OUTBOX) ?? "[]"); } catch { return []; }
}

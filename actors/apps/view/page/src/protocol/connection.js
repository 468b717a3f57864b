// The WebSocket to the program, which is reopened when it is lost.
import { decodeBackdrops } from './decode_backdrops.js';
import { decodeFrame, ProtocolError } from './decode_frame.js';
import { decodeMessage } from './decode_message.js';
import { decodeLibrary } from './decode_library.js';
import { decodePeople } from './decode_people.js';
import { Outbox } from './outbox.js';

const firstPauseMs = 500;
const longestPauseMs = 8000;
/** A program that sends this many malformed messages is another program, or another version. */
const faultsMost = 20;

/** On the page's own host; only the token of the page's address is passed on. */
function beside(page, name) {
  const url = new URL(name, page);
  const token = new URL(page).searchParams.get('token');
  url.search = token === null ? '' : `?${new URLSearchParams({ token })}`;
  url.hash = '';
  return url;
}

/** `/live`, where the socket is. */
export function liveAddress(page) {
  const url = beside(page, 'live');
  url.protocol = url.protocol === 'https:' ? 'wss:' : 'ws:';
  return url.href;
}

/** What does not change while the program serves. */
async function fixed(page, name, ask) {
  const answer = await ask(beside(page, name).href);
  if (!answer.ok) throw new Error(`the program answers ${answer.status}`);
  return answer.json();
}

/** The drawings under plans. */
export const backdropsOf = async (page, ask = fetch) =>
  decodeBackdrops(await fixed(page, 'backdrops.json', ask));

/** What may be added. */
export const libraryOf = async (page, ask = fetch) =>
  decodeLibrary(await fixed(page, 'library.json', ask));

/** The people who walk. */
export const peopleOf = async (page, ask = fetch) =>
  decodePeople(await fixed(page, 'people.json', ask));

export class Connection {
  /** `heard(messageOrFrame)`, `state('connecting' | 'open' | 'lost', words)`, `fault(words)`. */
  constructor(address, { heard, state, fault }) {
    Object.assign(this, { address, heard, state, fault });
    this.pauseMs = firstPauseMs;
    this.outbox = new Outbox((text) => this.socket.send(text));
    this.open();
  }

  open() {
    this.state('connecting', 'Connecting to the program …');
    this.faults = 0;
    this.socket = new WebSocket(this.address);
    this.socket.binaryType = 'arraybuffer';
    this.socket.onopen = () => {
      this.pauseMs = firstPauseMs;
      this.state('open', 'Connected');
    };
    this.socket.onmessage = ({ data }) => this.read(data);
    this.socket.onclose = () => this.lost();
  }

  read(data) {
    try {
      this.heard(typeof data === 'string' ? decodeMessage(data) : decodeFrame(data));
    } catch (error) {
      if (!(error instanceof ProtocolError)) throw error;
      this.fault(`The program said what this page does not understand: ${error.message}`);
      if (++this.faults >= faultsMost) this.socket.close();
    }
  }

  lost() {
    this.outbox.clear();
    const seconds = Math.max(1, Math.round(this.pauseMs / 1000));
    this.state('lost', `The connection is lost; trying again in ${seconds} s. The picture stays.`);
    setTimeout(() => this.open(), this.pauseMs);
    this.pauseMs = Math.min(longestPauseMs, 2 * this.pauseMs);
  }

  /** Sends if connected; returns whether the message was accepted. */
  say(message, key) {
    if (this.socket.readyState !== WebSocket.OPEN) return false;
    this.outbox.put(message, key);
    return true;
  }
}

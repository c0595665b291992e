/**
 * What an embedded page and the page around it say to each other by `postMessage`. Only with the origin that the
 * address names: `embed-origin=https://course.example.edu`.
 */
import { cutText } from '../../model/names/cut-text.ts';
import type { CameraView } from '../../view/camera/camera.ts';
import { numbersIn, viewOf } from '../../view/camera/view-numbers.ts';

/** From the page around. */
export type ToEmbedded =
  /** Seconds of the transport. */
  | { readonly marrow: 'seek'; readonly time: number }
  | { readonly marrow: 'play' }
  | { readonly marrow: 'pause' }
  /** Addresses, as in `files=`; what was open goes. */
  | { readonly marrow: 'open'; readonly files: readonly string[] }
  /** As in `camera=`. */
  | { readonly marrow: 'camera'; readonly view: CameraView }
  /** A joint's name. */
  | { readonly marrow: 'select'; readonly joint: string };

/** To the page around. */
export type FromEmbedded =
  /** Something is open. Seconds. */
  | { readonly marrow: 'ready'; readonly characters: readonly string[]; readonly range: readonly [number, number] }
  /** Each frame in which it changes. */
  | { readonly marrow: 'time'; readonly time: number; readonly playing: boolean }
  /** A sentence: of a file, of the link, or about a message that can't be followed. */
  | { readonly marrow: 'error'; readonly message: string };

/** A message of the page around: what is wrong with it, as a sentence; undefined if it is none for Marrow. */
export function readMessage(data: unknown): ToEmbedded | string | undefined {
  if (typeof data !== 'object' || data === null || !('marrow' in data)) return undefined;
  const { marrow: name } = data;
  const field = (key: string): unknown => Object.entries(data).find(([own]) => own === key)?.[1];
  switch (name) {
    case 'play':
    case 'pause':
      return { marrow: name };
    case 'seek': {
      const time = field('time');
      return isUsual(time) ? { marrow: name, time } : 'The message "seek" takes a time in seconds.';
    }
    case 'open': {
      const files = field('files');
      const isList = Array.isArray(files) && files.length > 0 && files.every((file) => typeof file === 'string');
      return isList ? { marrow: name, files } : 'The message "open" takes files: a list of addresses.';
    }
    case 'camera': {
      const numbers = field('view');
      const isList = Array.isArray(numbers) && numbers.every(isUsual);
      const view = isList ? viewOf(numbersIn(numbers.join(), 6)) : undefined;
      return view ? { marrow: name, view } : 'The message "camera" takes a view: six numbers, as in a link.';
    }
    case 'select': {
      const joint = field('joint');
      return typeof joint === 'string' ? { marrow: name, joint } : 'The message "select" takes the name of a joint.';
    }
    default:
      // Not every object can be put into words.
      return `There is no message ${typeof name === 'string' ? cutText(JSON.stringify(name)) : 'of that name'}; there are seek, play, pause, open, camera and select.`;
  }
}

/** An origin as browsers give it to messages, from any address there; undefined for what names none. */
export function originOf(address: string): string | undefined {
  const origin = URL.canParse(address) ? new URL(address).origin : 'null';
  return origin === 'null' ? undefined : origin;
}

function isUsual(value: unknown): value is number {
  return typeof value === 'number' && Number.isFinite(value);
}

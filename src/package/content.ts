/** The content of a file as callers have it. */
import { UserError } from '../model/user-error.ts';

/** Text, or bytes: UTF-8 of text formats. A Buffer of Node is one, too. */
export type Content = string | Uint8Array | ArrayBuffer;

/**
 * The bytes of a file.
 * @throws UserError for anything but a content, such as a promise that was not awaited
 */
export function bytesOf(content: Content): Uint8Array<ArrayBuffer> {
  if (typeof content === 'string') return new TextEncoder().encode(content);
  if (content instanceof ArrayBuffer) return new Uint8Array(content);
  // Views of shared memory are copied, since decoders refuse it.
  if (ArrayBuffer.isView(content))
    return content.buffer instanceof ArrayBuffer ? view(content) : new Uint8Array(content);
  const found: unknown = content;
  const what = found instanceof Promise ? 'a promise; await it' : found === null ? 'null' : typeof found;
  throw new UserError(`Expected the text or the bytes of a file, found ${what}.`);
}

function view({ buffer, byteOffset, byteLength }: Uint8Array): Uint8Array<ArrayBuffer> {
  // Checked by the caller, which TypeScript doesn't see in a property.
  return new Uint8Array(buffer as ArrayBuffer, byteOffset, byteLength);
}

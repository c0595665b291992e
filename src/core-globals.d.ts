/**
 * The few names that a page, a worker and Node all have, but that the language's own library does not declare.
 * Only `tsconfig.core.json` reads this file: it is what keeps the core free of the DOM and of Node.
 */
declare class TextDecoder {
  constructor(label?: string, options?: { fatal?: boolean; ignoreBOM?: boolean });
  decode(input?: ArrayBufferView | ArrayBuffer, options?: { stream?: boolean }): string;
}
declare class TextEncoder {
  encode(input?: string): Uint8Array<ArrayBuffer>;
}

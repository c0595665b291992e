/**
 * The few globals that pages, workers and Node share, but that the library of ECMAScript does not declare. Only
 * `tsconfig.core.json` includes this file: with it the core compiles without the types of the DOM and Node.
 */
declare class TextDecoder {
  constructor(label?: string, options?: { fatal?: boolean; ignoreBOM?: boolean });
  decode(input?: ArrayBufferView | ArrayBuffer, options?: { stream?: boolean }): string;
}
declare class TextEncoder {
  encode(input?: string): Uint8Array<ArrayBuffer>;
}

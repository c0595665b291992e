/** As much of Draco's decoder as is used, by `plugins/draco.ts`. */
declare module 'virtual:draco' {
  interface Status {
    ok(): boolean;
    error_msg(): string;
  }
  interface Attribute {
    num_components(): number;
  }
  interface Mesh {
    num_points(): number;
    num_faces(): number;
  }
  interface DecoderBuffer {
    Init(bytes: Int8Array, length: number): void;
  }
  interface Decoder {
    GetEncodedGeometryType(buffer: DecoderBuffer): number;
    DecodeBufferToMesh(buffer: DecoderBuffer, mesh: Mesh): Status;
    GetAttributeByUniqueId(mesh: Mesh, id: number): Attribute;
    GetTrianglesUInt32Array(mesh: Mesh, bytes: number, pointer: number): boolean;
    GetAttributeDataArrayForAllPoints(
      mesh: Mesh,
      attribute: Attribute,
      type: number,
      bytes: number,
      pointer: number,
    ): boolean;
  }
  /** Base64. */
  export const wasm: string;
  export function make(options: { wasmBinary: Uint8Array }): Promise<{
    readonly Decoder: new () => Decoder;
    readonly DecoderBuffer: new () => DecoderBuffer;
    readonly Mesh: new () => Mesh;
    readonly TRIANGULAR_MESH: number;
    readonly DT_FLOAT32: number;
    readonly DT_INT32: number;
    readonly HEAPU8: Uint8Array<ArrayBuffer>;
    _malloc(bytes: number): number;
    _free(pointer: number): void;
    destroy(object: unknown): void;
  }>;
}

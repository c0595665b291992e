/** As much of Draco's encoder as the tests use; the package has no types. */
declare module 'draco3dgltf' {
  interface Mesh {
    readonly isMesh?: true;
  }
  interface Bytes {
    GetValue(index: number): number;
  }
  const draco: {
    createEncoderModule(options: object): Promise<{
      readonly Encoder: new () => {
        SetEncodingMethod(method: number): void;
        SetAttributeQuantization(attribute: number, bits: number): void;
        EncodeMeshToDracoBuffer(mesh: Mesh, out: Bytes): number;
      };
      readonly MeshBuilder: new () => {
        AddFacesToMesh(mesh: Mesh, faces: number, corners: Uint32Array): void;
        AddFloatAttributeToMesh(mesh: Mesh, kind: number, points: number, width: number, values: Float32Array): number;
      };
      readonly Mesh: new () => Mesh;
      readonly DracoInt8Array: new () => Bytes;
      readonly POSITION: number;
      readonly MESH_SEQUENTIAL_ENCODING: number;
    }>;
  };
  export default draco;
}

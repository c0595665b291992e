/**
 * Balls and bones of all nodes in one small buffer: 8 floats a node, from which the vertex shader builds the matrices.
 * Built on the CPU, that would be 32 floats to compute and upload every frame.
 *
 *     nodeEnd    x y z of the node, radius of its ball
 *     nodeStart  x y z of the start of its bone, the bone's radius there
 *
 * Materials and meshes are three.js's instanced ones; `instanceMatrix` in their shaders is replaced.
 */
import {
  type BufferGeometry,
  DynamicDrawUsage,
  InstancedBufferAttribute,
  InstancedInterleavedBuffer,
  InstancedMesh,
  InterleavedBufferAttribute,
  type Material,
  type Matrix4,
  MeshDepthMaterial,
  type Vector2,
} from 'three';
import { boneMatrix, sphereMatrix } from '../../evaluate/shapes/joint-shapes.ts';
import { LINE_RESOLUTION } from '../scene/thick-lines.ts';

export type NodeShape = 'ball' | 'bone';

/** Floats per node. */
export const NODE_STRIDE = 8;

export class NodeBuffer {
  private buffer = interleaved(1);

  /** 8 a node, as above. */
  get values(): Float32Array {
    // Created below as a Float32Array; three.js types it as any array.
    return this.buffer.array as Float32Array;
  }

  /** Makes room for `count` nodes and attaches the buffer to these geometries. */
  resize(count: number, geometries: readonly BufferGeometry[]): void {
    if (count > this.buffer.count) this.buffer = interleaved(count);
    for (const geometry of geometries) {
      const attribute = geometry.attributes.nodeEnd;
      if (attribute instanceof InterleavedBufferAttribute && attribute.data === this.buffer) continue;
      geometry.setAttribute('nodeEnd', new InterleavedBufferAttribute(this.buffer, 4, 0));
      geometry.setAttribute('nodeStart', new InterleavedBufferAttribute(this.buffer, 4, 4));
    }
  }

  /** Uploads with the next draw. */
  filled(): void {
    this.buffer.needsUpdate = true;
  }
}

function interleaved(count: number): InstancedInterleavedBuffer {
  const buffer = new InstancedInterleavedBuffer(new Float32Array(NODE_STRIDE * count), NODE_STRIDE, 1);
  buffer.setUsage(DynamicDrawUsage);
  return buffer;
}

/** Scratch, never escapes: start and end of a bone, as matrices of which only the translation is read. */
const ends = new Float64Array(32);
const made = new Float32Array(16);

/** Balls or bones: `count` instances without matrices of their own. */
export class NodeMesh extends InstancedMesh {
  constructor(
    geometry: BufferGeometry,
    material: Material,
    capacity: number,
    readonly shape: NodeShape,
  ) {
    super(geometry, material, 1);
    this.instanceColor = new InstancedBufferAttribute(new Float32Array(3 * capacity).fill(1), 3);
    this.customDepthMaterial = drawnByNodes(new MeshDepthMaterial(), shape);
  }

  /** The matrix that the shader builds from the buffer. */
  override getMatrixAt(index: number, matrix: Matrix4): Matrix4 {
    const { nodeEnd, nodeStart } = this.geometry.attributes;
    for (let k = 0; k < 3; k++) {
      ends[12 + k] = nodeStart.getComponent(index, k);
      ends[28 + k] = nodeEnd.getComponent(index, k);
    }
    made.fill(0);
    if (this.shape === 'ball') sphereMatrix(ends[28], ends[29], ends[30], nodeEnd.getW(index), made, 0);
    else boneMatrix(ends, 0, 16, nodeStart.getW(index), made, 0);
    return matrix.fromArray(made);
  }

  override dispose(): void {
    this.customDepthMaterial?.dispose();
    super.dispose();
  }
}

/** `sphereMatrix` and `boneMatrix` of `joint-shapes.ts`. */
const MATRICES: Readonly<Record<NodeShape, string>> = {
  ball: /* glsl */ `
    float r = nodeRadius(nodeEnd, 1.0);
    nodeMatrix = mat4(r, 0.0, 0.0, 0.0, 0.0, r, 0.0, 0.0, 0.0, 0.0, r, 0.0, nodeEnd.xyz, 1.0);
  `,
  bone: /* glsl */ `
    vec3 way = nodeEnd.xyz - nodeStart.xyz;
    float span = length(way);
    float r = nodeRadius(nodeStart, 0.75);
    nodeMatrix = mat4(vec4(0.0), vec4(0.0), vec4(0.0), vec4(nodeStart.xyz, 1.0));
    if (span > 0.0) {
      vec3 d = way / span;
      float s = d.y >= 0.0 ? 1.0 : -1.0;
      float a = -1.0 / (s + d.y);
      float b = d.x * d.z * a;
      nodeMatrix[0].xyz = r * vec3(1.0 + s * d.x * d.x * a, -s * d.x, s * b);
      nodeMatrix[1].xyz = way;
      nodeMatrix[2].xyz = r * vec3(b, -d.z, s + d.z * d.z * a);
    }
  `,
};

/** Uniforms of all materials of balls and bones: a factor of their radius, and the least radius of a ball in pixels. */
const NODE_THICKNESS = { value: 1 };
const MIN_PIXELS = { value: 2.6 };
/** Shadows are not on the screen. */
const NO_MIN_PIXELS = { value: 0 };

/** Sets how thick bones are drawn; 1 follows from the skeleton's size. */
export function setNodeThickness(thickness: number): void {
  NODE_THICKNESS.value = thickness;
}

/**
 * Adapts the material for a `NodeMesh` of this shape.
 *
 * @param resolution of what it is drawn on, in the pixels that the least width is counted in
 */
export function drawnByNodes<M extends Material>(
  material: M,
  shape: NodeShape,
  resolution: { readonly value: Vector2 } = LINE_RESOLUTION,
): M {
  const minPixels = material instanceof MeshDepthMaterial ? NO_MIN_PIXELS : MIN_PIXELS;
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, { nodeThickness: NODE_THICKNESS, nodeMinPixels: minPixels, nodeOn: resolution });
    shader.vertexShader = /* glsl */ `
      attribute vec4 nodeEnd;
      attribute vec4 nodeStart;
      uniform float nodeThickness;
      uniform float nodeMinPixels;
      uniform vec2 nodeOn;
      mat4 nodeMatrix;
      // Its radius, but not less than so many pixels; 0 is not drawn.
      float nodeRadius(vec4 node, float part) {
        float w = (projectionMatrix * (modelViewMatrix * vec4(node.xyz, 1.0))).w;
        float pixel = 2.0 * abs(w) / (projectionMatrix[1][1] * nodeOn.y);
        return node.w > 0.0 ? max(node.w * nodeThickness, part * nodeMinPixels * pixel) : 0.0;
      }
      #define instanceMatrix nodeMatrix
      ${shader.vertexShader.replace('void main() {', `void main() { {${MATRICES[shape]}}`)}
    `;
  };
  material.customProgramCacheKey = () => `nodes as ${shape}`;
  return material;
}

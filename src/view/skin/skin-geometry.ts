/**
 * A skin's data for the GPU: doubles become floats, and any number of attachments becomes
 *
 *     skinIndex, skinWeight     the first four; missing ones have weight 0
 *     attachmentTexture         all past the fourth, one texel (joint, weight) each, vertex after vertex
 *     attachmentRange           a vertex's range in it
 *
 * A vertex without attachments is bound to the identity at the end of the bone matrices; so are all vertices without a
 * skeleton. A skin without any attachments is bound to the root.
 *
 * Triangles are wound consistently, and `turned` marks normals that disagree with that: see `facing.ts`.
 */
import {
  BufferAttribute,
  BufferGeometry,
  DataTexture,
  FloatType,
  InstancedBufferAttribute,
  InstancedBufferGeometry,
  RGFormat,
} from 'three';
import type { Steps } from '../../evaluate/steps.ts';
import { type Skin, vertexCount } from '../../model/skin.ts';
import { afterInTriangle, facingOf } from './facing.ts';
import { looksOf } from './skin-looks.ts';

/** Attachments that the attributes hold. */
const IN_ATTRIBUTES = 4;
/** Vertices or edges between two yields: under a millisecond's work. */
const STRIDE = 16384;
/** Texels per row of the attachment texture: the maximum texture size that WebGL2 guarantees. */
export const ATTACHMENT_ROW = 2048;
/** Above this, Uint16 indices don't fit, and three.js treats integers as such for `vec4` only. */
const LARGEST_SHORT = 0xffff;

export interface PackedSkin {
  readonly geometry: BufferGeometry;
  readonly attachmentTexture: DataTexture | undefined;
}

/**
 * @param normals x y z per vertex
 * @param identity index of the identity among the bone matrices
 * @param isPosed whether there is a skeleton
 */
export function* packSkin(skin: Skin, normals: Float64Array, identity: number, isPosed: boolean): Steps<PackedSkin> {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(yield* floatsOf(skin.positions, 0), 3));
  geometry.setAttribute('normal', new BufferAttribute(yield* floatsOf(normals, 0.1), 3));
  if (skin.texcoords) geometry.setAttribute('uv', new BufferAttribute(yield* floatsOf(skin.texcoords, 0.2), 2));
  const facing = facingOf(skin.triangles, skin.positions, normals);
  let step = facing.next();
  for (; !step.done; step = facing.next()) yield 0.3 + 0.3 * step.value;
  // The model's own array if it is consistent: three.js only reads it.
  geometry.setIndex(new BufferAttribute(step.value.triangles, 1));
  const { looks, runs } = looksOf(skin);
  // Without groups a mesh needs one draw call.
  for (const run of looks.length > 1 ? runs : [])
    geometry.addGroup(3 * run.triangleStart, 3 * run.triangleCount, run.look);
  geometry.setAttribute('turned', new BufferAttribute(step.value.turned, 1));
  const attachmentTexture = yield* packAttachments(skin, identity, isPosed, geometry);
  return { geometry, attachmentTexture };
}

/** @param done progress of the whole work */
function* floatsOf(doubles: Float64Array, done: number): Steps<Float32Array<ArrayBuffer>> {
  const floats = new Float32Array(doubles.length);
  for (let i = 0; i < doubles.length; i += STRIDE) {
    floats.set(doubles.subarray(i, i + STRIDE), i);
    yield done + (0.1 * i) / doubles.length;
  }
  return floats;
}

function* packAttachments(
  skin: Skin,
  identity: number,
  isPosed: boolean,
  geometry: BufferGeometry,
): Steps<DataTexture | undefined> {
  const vertices = vertexCount(skin);
  const { attachments } = skin;
  const indices =
    identity > LARGEST_SHORT ? new Float32Array(IN_ATTRIBUTES * vertices) : new Uint16Array(IN_ATTRIBUTES * vertices);
  const weights = new Float32Array(IN_ATTRIBUTES * vertices);
  let more = 0;
  for (let v = 0; v < vertices; v++) {
    const first = attachments ? attachments.start[v] : 0;
    const count = !isPosed ? 0 : attachments ? attachments.start[v + 1] - first : 1;
    const o = IN_ATTRIBUTES * v;
    if (count === 0) {
      indices[o] = identity;
      weights[o] = 1;
    } else if (attachments) {
      const here = Math.min(count, IN_ATTRIBUTES);
      for (let i = 0; i < here; i++) {
        indices[o + i] = attachments.joints[first + i];
        weights[o + i] = attachments.weights[first + i];
      }
      more += count - here;
    } else weights[o] = 1;
    if (v % STRIDE === STRIDE - 1) yield 0.6 + (0.3 * v) / vertices;
  }
  geometry.setAttribute('skinIndex', new BufferAttribute(indices, IN_ATTRIBUTES));
  geometry.setAttribute('skinWeight', new BufferAttribute(weights, IN_ATTRIBUTES));
  if (more === 0 || !attachments) return undefined;

  const ranges = new Uint32Array(2 * vertices);
  const texels = new Float32Array(2 * ATTACHMENT_ROW * Math.ceil(more / ATTACHMENT_ROW));
  let next = 0;
  for (let v = 0; v < vertices; v++) {
    ranges[2 * v] = next;
    for (let a = attachments.start[v] + IN_ATTRIBUTES; a < attachments.start[v + 1]; a++) {
      texels[2 * next] = attachments.joints[a];
      texels[2 * next + 1] = attachments.weights[a];
      next++;
    }
    ranges[2 * v + 1] = next;
    if (v % STRIDE === STRIDE - 1) yield 0.9 + (0.1 * v) / vertices;
  }
  geometry.setAttribute('attachmentRange', new BufferAttribute(ranges, 2));
  const texture = new DataTexture(texels, ATTACHMENT_ROW, texels.length / 2 / ATTACHMENT_ROW, RGFormat, FloatType);
  texture.needsUpdate = true;
  return texture;
}

/**
 * The triangles' edges as pairs of vertices, each edge once. (three.js's `wireframe` lists an edge once per triangle,
 * in one loop that blocks the page for 2 million triangles.)
 *
 * Edges are bucketed by their lower vertex in two passes; duplicates are found by marking the upper ones.
 */
export function* edgesOf(triangles: Uint32Array, vertices: number): Steps<Uint32Array<ArrayBuffer>> {
  const start = new Uint32Array(vertices + 1);
  const all = triangles.length;
  for (let i = 0; i < all; i++) {
    start[Math.min(triangles[i], triangles[afterInTriangle(i)]) + 1]++;
    if (i % STRIDE === STRIDE - 1) yield (0.3 * i) / all;
  }
  for (let v = 0; v < vertices; v++) start[v + 1] += start[v];
  yield 0.35;
  const upper = new Uint32Array(all);
  const filled = start.slice(0, vertices);
  for (let i = 0; i < all; i++) {
    const a = triangles[i];
    const b = triangles[afterInTriangle(i)];
    upper[filled[Math.min(a, b)]++] = Math.max(a, b);
    if (i % STRIDE === STRIDE - 1) yield 0.35 + (0.3 * i) / all;
  }
  // Vertex v's mark: seen as the upper end of an edge whose lower end is mark − 1.
  const mark = new Uint32Array(vertices);
  const pairs = new Uint32Array(2 * all);
  let count = 0;
  for (let v = 0; v < vertices; v++) {
    for (let e = start[v]; e < start[v + 1]; e++) {
      const u = upper[e];
      if (mark[u] === v + 1 || u === v) continue;
      mark[u] = v + 1;
      pairs[count++] = v;
      pairs[count++] = u;
    }
    if (v % STRIDE === STRIDE - 1) yield 0.65 + (0.35 * v) / vertices;
  }
  return pairs.slice(0, count);
}

/** A line per vertex, which is the instance: `gl_VertexID` 0 at the surface and 1 at the tip. */
export function normalsGeometry(surface: BufferGeometry): InstancedBufferGeometry {
  const geometry = new InstancedBufferGeometry();
  for (const [name, attribute] of Object.entries(surface.attributes)) {
    // Its own GPU buffer, since the divisor belongs to the buffer; the array is shared.
    geometry.setAttribute(name, new InstancedBufferAttribute(attribute.array, attribute.itemSize));
  }
  geometry.instanceCount = surface.getAttribute('position').count;
  geometry.setDrawRange(0, 2);
  return geometry;
}

/**
 * The content of a file of another program (glTF, VRM, FBX) in our terms, before it becomes a character: nodes with
 * their rest, meshes on nodes, takes of curves on nodes. `to-character.ts` makes joints, one skin, morphs and takes of
 * it.
 *
 *     world of a node = world of its parent · T(translation) · R(rotation) · S(scale)
 *
 * Doubles; right-handed, y up; radians and seconds; matrices column-major; the file's own unit of length. A reader that
 * has other axes or units converts them: what is here is the result.
 */
import type { Vec3 } from '../math/vec3.ts';
import type { Texture } from '../model/files.ts';
import type { MorphRows } from '../model/morph.ts';
import type { EulerOrder } from '../model/skeleton/skeleton.ts';
import type { Attachments } from '../model/skin.ts';
import type { Channel } from '../model/takes/take.ts';
import type { QuaternionTrack } from '../model/takes/tracked-take.ts';

/** All that is read of a file. */
export interface Scene {
  /** Name of the character: the file's name without its extension. */
  readonly name: string;
  /** Metres per unit of length, as the file or its format states; greater than 0. */
  readonly metres: number;
  /** In depth-first pre-order; there may be several roots. Those that a character doesn't need are left out later. */
  readonly nodes: readonly SceneNode[];
  /** In the order in which their vertices are listed. */
  readonly meshes: readonly SceneMesh[];
  readonly materials: readonly SceneMaterial[];
  readonly textures: readonly Texture[];
  readonly takes: readonly SceneTake[];
}

/** x y z w, normalised. */
export type Quaternion = readonly [number, number, number, number];

/** A node at rest. */
export interface SceneNode {
  /** As in the file; may be empty, or that of another node. */
  readonly name: string;
  /** Smaller than the node's own index; -1 for a root. */
  readonly parent: number;
  readonly translation: Vec3;
  readonly rotation: Quaternion;
  readonly scale: Vec3;
  /**
   * The rest as Euler angles, for files that have those. The joint then turns in this order, whether or not another
   * would be clearer of gimbal lock, and rests at exactly these angles. `rotation` is the same.
   */
  readonly euler?: SceneEuler;
  /** Becomes a joint though nothing moves it and nothing hangs on it, as bones do. Joints of skins do anyway. */
  readonly isBone?: boolean;
  /** A part of the body, where the file says so. */
  readonly role?: string;
}

/** A rotation as Euler angles, in radians. */
export interface SceneEuler {
  readonly order: EulerOrder;
  /** About x, y and z, whatever the order. */
  readonly angles: Vec3;
}

/** All triangles of one node. */
export interface SceneMesh {
  readonly name: string;
  /** Without a skin its vertices hang on this node; with one the node has no influence on them. */
  readonly node: number;
  /** x y z per vertex, in the space of the node or, with a skin, of its inverse bind matrices. */
  readonly positions: Float64Array;
  /** x y z per vertex, of any length; NaN per vertex without one; absent: computed. */
  readonly normals?: Float64Array;
  /** u v per vertex; v points up. */
  readonly texcoords?: Float64Array;
  readonly surfaces: readonly SceneSurface[];
  readonly skinned?: SceneSkinned;
  readonly targets: readonly SceneTarget[];
}

/** The triangles of one material. */
export interface SceneSurface {
  /** Index into the materials; -1 for none. */
  readonly material: number;
  /** Three vertices of the mesh per triangle. */
  readonly triangles: Uint32Array;
}

/** How the vertices of a mesh hang on joints. */
export interface SceneSkinned {
  /** The same object for meshes that share it. */
  readonly skin: SceneSkin;
  /** `joints` are indices into those of the skin. */
  readonly attachments: Attachments;
}

/** Joints with their bindings. */
export interface SceneSkin {
  /** Nodes, each at most once. */
  readonly joints: readonly number[];
  /** 16 per joint: from the space of the vertices to that of the joint, when the skin was bound. */
  readonly inverseBinds: Float64Array;
}

/** A morph target: absolute values for some vertices of its mesh, in the space of the mesh. */
export interface SceneTarget {
  readonly name: string;
  readonly positions: MorphRows;
  readonly normals: MorphRows;
  /** Where no curve says otherwise. */
  readonly weight: number;
}

/** A material, as far as skins have it. */
export interface SceneMaterial {
  readonly name: string;
  /** Linear red, green and blue, 0 to 1; without a texture. */
  readonly color?: Vec3;
  /** The name of one of the textures, or of a file that was not given. */
  readonly texture?: string;
}

/** An animation of nodes and morph weights, in seconds. */
export interface SceneTake {
  readonly name: string;
  /** First and last second. */
  readonly range: readonly [number, number];
  /** As the file states, else of its keys, which fitting adds to; absent for keys at uneven times. */
  readonly framesPerSecond?: number;
  /** Moves of nodes, at most one for each. */
  readonly moves: readonly SceneMove[];
  readonly weights: readonly SceneWeight[];
}

/** How a take moves a node. What has no curve rests. */
export interface SceneMove {
  readonly node: number;
  readonly translation?: AxisCurves;
  readonly rotation?: SceneRotation;
  readonly scale?: AxisCurves;
}

/** Curves of x, y and z, in absolute values: keys and tangents are kept. Absent where an axis rests. */
export type AxisCurves = readonly [Channel | undefined, Channel | undefined, Channel | undefined];

/** Euler angles are kept with their keys and tangents; quaternions are fitted once something asks for them. */
export type SceneRotation =
  /** In the order of the node's `euler`, which must be there. */
  { readonly kind: 'euler'; readonly angles: AxisCurves } | { readonly kind: 'turns'; readonly track: QuaternionTrack };

/** How a take drives the weight of a morph target. */
export interface SceneWeight {
  /** Index into the meshes. */
  readonly mesh: number;
  /** Index into its targets. */
  readonly target: number;
  readonly curve: Channel;
}

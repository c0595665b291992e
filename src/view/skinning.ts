/**
 * Exact smooth skinning with three.js, in one place:
 *
 *     v′ = Σ wᵢ · Mᵢ · v          n′ = normalised Σ wᵢ · Mᵢ⁻ᵀ · n          Mᵢ = Wᵢ · Bᵢ⁻¹
 *
 * three.js's own is right for 1 to 4 attachments and rigid Mᵢ only. What is different here:
 *
 *  - Bone matrices Mᵢ are in the character's space: `bindMatrix` is the identity and the mesh's `matrixWorld` is the
 *    placement, so one bone texture serves every placement, and weights that don't sum to 1 scale about the
 *    character's own origin, on the GPU and in `getVertexPosition` alike.
 *  - The bone texture has one matrix more than there are joints, the identity. A vertex without attachments hangs on
 *    it and stays where it is; three.js sends it to the origin.
 *  - The first four attachments are in the attributes `skinIndex` and `skinWeight`; further ones, any number of them,
 *    are pairs (joint, weight) in a texture, in which a vertex has the range `attachmentRange`. Shaders know of it only
 *    where a skin has such vertices.
 *  - Normals are turned by the inverse transpose, which is the cofactor matrix over the determinant.
 *  - `applyBoneTransform` does the same sums in doubles.
 *
 * Rejected: two more pairs of attributes (eight attachments, and 9 occur), summing all in the texture (a dependent
 * fetch more for the usual four), and matrices relative to the root (exact far away from the origin in floats too, but
 * wrong where weights don't sum to 1).
 */
import {
  type Bone,
  type Box3,
  type BufferGeometry,
  DataTexture,
  DetachedBindMode,
  FloatType,
  LineSegments,
  type Material,
  Matrix4,
  MeshNormalMaterial,
  RGBAFormat,
  ShaderChunk,
  Skeleton,
  SkinnedMesh,
  type Sphere,
  Vector3,
  Vector4,
  type WebGLProgramParametersWithUniforms,
  type WebGLRenderer,
} from 'three';
import { setIdentity } from '../math/mat4.ts';
import type { Attachments, Skin } from '../model/skin.ts';

/** A skin as the GPU has it: made once, shared by every placement and every way of drawing it. */
export interface SkinGpu {
  readonly skin: Skin;
  readonly geometry: BufferGeometry;
  readonly skeleton: ExactSkeleton;
  /** Without a skeleton a skin is left as it is, whatever its weights sum to. */
  readonly isPosed: boolean;
  /** Attachments past the fourth, where there are any: see `skin-geometry.ts`. */
  readonly attachmentTexture: DataTexture | undefined;
}

/** A skeleton whose bone matrices are given, in doubles, and which ends in the identity. */
export class ExactSkeleton extends Skeleton {
  /** Mᵢ, 16 numbers a joint, column-major, in the character's space; after the last joint's, the identity. */
  readonly matrices: Float64Array;
  override boneMatrices: Float32Array;
  override boneTexture: DataTexture;

  /**
   * @param jointCount at least as many as the skin's attachments speak of
   * @param inverseBindings 16 numbers a joint, for whoever exports this; bones past its end get the identity
   */
  constructor(bones: Bone[], jointCount: number, inverseBindings: Float64Array) {
    super(
      bones,
      bones.map((_, j) => {
        const inverse = new Matrix4();
        return 16 * j < inverseBindings.length ? inverse.fromArray(inverseBindings, 16 * j) : inverse;
      }),
    );
    this.matrices = new Float64Array(16 * (jointCount + 1));
    const side = Math.max(4, 4 * Math.ceil(Math.sqrt(4 * (jointCount + 1)) / 4));
    this.boneMatrices = new Float32Array(4 * side * side);
    this.boneTexture = new DataTexture(this.boneMatrices, side, side, RGBAFormat, FloatType);
    for (let m = 0; m < this.matrices.length; m += 16) setIdentity(this.matrices, m);
    this.upload();
  }

  /** Which matrix is the identity. */
  get identityIndex(): number {
    return this.matrices.length / 16 - 1;
  }

  /** Makes the GPU's matrices those in `matrices`, when it draws next. */
  upload(): void {
    this.boneMatrices.set(this.matrices);
    this.boneTexture.needsUpdate = true;
  }

  /** three.js asks for this before it draws; `upload` has done it. */
  override update(): void {}

  override computeBoneTexture(): this {
    return this;
  }

  /** Frees the texture on the GPU. (three.js would forget the texture as well, and then fail on its null.) */
  override dispose(): void {
    this.boneTexture.dispose();
  }
}

const point = new Vector4();

/** One placement of a skin. */
export class MarrowSkinnedMesh extends SkinnedMesh<BufferGeometry, Material> {
  /**
   * @param sphere around the posed character, in its own space; kept by reference and up to date by its owner, so that
   * three.js never walks the vertices and never culls by where the character was before
   */
  constructor(
    readonly gpu: SkinGpu,
    material: Material,
    sphere: Sphere,
    box: Box3,
  ) {
    super(gpu.geometry, material);
    this.bindMode = DetachedBindMode;
    this.bind(gpu.skeleton, new Matrix4());
    this.boundingSphere = sphere;
    this.boundingBox = box;
    this.matrixAutoUpdate = false;
  }

  override applyBoneTransform(index: number, target: Vector3): Vector3;
  override applyBoneTransform(index: number, target: Vector4): Vector4;
  override applyBoneTransform(index: number, target: Vector3 | Vector4): Vector3 | Vector4 {
    const { skin, skeleton, isPosed } = this.gpu;
    if (!isPosed) return target;
    const isPoint = target instanceof Vector3;
    point.set(target.x, target.y, target.z, isPoint ? 1 : target.w);
    transformBy(skin.attachments, index, skeleton.matrices, point);
    if (target instanceof Vector3) return target.set(point.x, point.y, point.z);
    return target.copy(point);
  }
}

/** Σ wᵢ · Mᵢ · v in place, w kept as it is. Without attachments at all a skin hangs on the root, joint 0. */
function transformBy(attachments: Attachments | undefined, vertex: number, matrices: Float64Array, v: Vector4): void {
  const { x, y, z, w } = v;
  const first = attachments ? attachments.start[vertex] : 0;
  const end = attachments ? attachments.start[vertex + 1] : 1;
  if (first === end) return;
  let sx = 0;
  let sy = 0;
  let sz = 0;
  for (let a = first; a < end; a++) {
    const m = 16 * (attachments ? attachments.joints[a] : 0);
    const weight = attachments ? attachments.weights[a] : 1;
    sx += weight * (matrices[m] * x + matrices[m + 4] * y + matrices[m + 8] * z + matrices[m + 12] * w);
    sy += weight * (matrices[m + 1] * x + matrices[m + 5] * y + matrices[m + 9] * z + matrices[m + 13] * w);
    sz += weight * (matrices[m + 2] * x + matrices[m + 6] * y + matrices[m + 10] * z + matrices[m + 14] * w);
  }
  v.set(sx, sy, sz, w);
}

/** Lines that follow a skin as its surface does. three.js skins whatever says `isSkinnedMesh` and has a skeleton. */
export class SkinnedLines extends LineSegments<BufferGeometry, Material> {
  readonly isSkinnedMesh = true;
  readonly skeleton: ExactSkeleton;
  readonly bindMatrix = new Matrix4();
  readonly bindMatrixInverse = new Matrix4();
  readonly boundingSphere: Sphere;

  constructor(geometry: BufferGeometry, material: Material, skeleton: ExactSkeleton, sphere: Sphere) {
    super(geometry, material);
    this.skeleton = skeleton;
    this.boundingSphere = sphere;
    this.matrixAutoUpdate = false;
  }

  /** Picking goes by the surface. */
  override raycast(): void {}
}

const BONE_MATRIX = /* glsl */ `
uniform highp sampler2D boneTexture;

mat4 getBoneMatrix( const in float i ) {
	int size = textureSize( boneTexture, 0 ).x;
	int j = int( i ) * 4;
	int x = j % size;
	int y = j / size;
	return mat4(
		texelFetch( boneTexture, ivec2( x, y ), 0 ),
		texelFetch( boneTexture, ivec2( x + 1, y ), 0 ),
		texelFetch( boneTexture, ivec2( x + 2, y ), 0 ),
		texelFetch( boneTexture, ivec2( x + 3, y ), 0 ) );
}

// m to the power of -T, times n. A matrix that flattens has no inverse; its cofactors still turn normals rightly.
vec3 turnNormal( const in mat4 m, const in vec3 n ) {
	vec3 a = m[ 0 ].xyz;
	vec3 b = m[ 1 ].xyz;
	vec3 c = m[ 2 ].xyz;
	vec3 bc = cross( b, c );
	float determinant = dot( a, bc );
	vec3 turned = bc * n.x + cross( c, a ) * n.y + cross( a, b ) * n.z;
	return determinant == 0.0 ? turned : turned / determinant;
}
`;

const MORE_ATTACHMENTS = /* glsl */ `
uniform highp sampler2D attachmentTexture;
in uvec2 attachmentRange;

// Joint and weight of an attachment past the fourth.
vec2 getAttachment( const in uint i ) {
	uint size = uint( textureSize( attachmentTexture, 0 ).x );
	return texelFetch( attachmentTexture, ivec2( int( i % size ), int( i / size ) ), 0 ).xy;
}
`;

/** Runs `body` for each attachment past the fourth. */
const forEachMore = (body: string) => /* glsl */ `
	for ( uint a = attachmentRange.x; a < attachmentRange.y; a ++ ) {
		vec2 attachment = getAttachment( a );
		${body}
	}
`;

/** three.js's chunks that know of skinning, as they are here. */
function skinningChunks(more: boolean): Readonly<Record<string, string>> {
  return {
    skinning_pars_vertex: `
#ifdef USE_SKINNING
${BONE_MATRIX}${more ? MORE_ATTACHMENTS : ''}
#endif
`,
    skinnormal_vertex: /* glsl */ `
#ifdef USE_SKINNING
	vec3 skinnedNormal = skinWeight.x * turnNormal( boneMatX, objectNormal )
		+ skinWeight.y * turnNormal( boneMatY, objectNormal )
		+ skinWeight.z * turnNormal( boneMatZ, objectNormal )
		+ skinWeight.w * turnNormal( boneMatW, objectNormal );
	${more ? forEachMore('skinnedNormal += attachment.y * turnNormal( getBoneMatrix( attachment.x ), objectNormal );') : ''}
	float skinnedLength = length( skinnedNormal );
	float unskinnedLength = length( objectNormal );
	objectNormal = skinnedLength > 0.0 ? skinnedNormal / skinnedLength
		: unskinnedLength > 0.0 ? objectNormal / unskinnedLength : vec3( 0.0 );
#endif
`,
    skinning_vertex: /* glsl */ `
#ifdef USE_SKINNING
	vec4 skinVertex = vec4( transformed, 1.0 );
	vec3 skinned = skinWeight.x * ( boneMatX * skinVertex ).xyz
		+ skinWeight.y * ( boneMatY * skinVertex ).xyz
		+ skinWeight.z * ( boneMatZ * skinVertex ).xyz
		+ skinWeight.w * ( boneMatW * skinVertex ).xyz;
	${more ? forEachMore('skinned += attachment.y * ( getBoneMatrix( attachment.x ) * skinVertex ).xyz;') : ''}
	transformed = skinned;
#endif
`,
  };
}

/**
 * Lighting by the file's normals, turned toward the viewer. `facing.ts` has made corners agree with the side that a
 * triangle is wound for, so which side is seen decides, once for a whole triangle, as in three.js; only where a matrix
 * mirrors, the other side it is. What then still leans away from the viewer, as smooth normals do near a silhouette, is
 * bent back to where it is just not seen from behind, which is continuous: no pixel is dark, and nothing jumps within a
 * triangle. Where there is no normal (zero length, or neighbours that cancel out) the geometric one is taken, which is
 * what the position's derivatives over the screen give.
 *
 * Rejected: deciding in each pixel by the geometric normal, which tears a triangle that has one bad corner; turning
 * round all that leans away, which gives silhouettes speckles lit from the wrong side.
 */
const LIGHTING_CHUNKS: Readonly<Record<string, string>> = {
  normal_pars_vertex: /* glsl */ `${ShaderChunk.normal_pars_vertex}
// 1 where the normal disagrees with how its triangles are wound; 0 where a geometry does not have it.
attribute float turned;
`,
  normal_vertex: edited('normal_vertex', [
    [
      'vNormal = normalize( transformedNormal );',
      `float transformedLength = length( transformedNormal );
	vNormal = transformedLength > 0.0 ? transformedNormal / transformedLength : vec3( 0.0 );
	vNormal *= 1.0 - 2.0 * turned;
#ifdef USE_SKINNING
	// What mirrors turns windings round, but no normals.
	if ( determinant( mat3( boneMatX ) ) < 0.0 ) vNormal = - vNormal;
#endif`,
    ],
  ]),
  normal_pars_fragment: /* glsl */ `${ShaderChunk.normal_pars_fragment}
// A normal of any length turned toward the viewer; position is the negative of that in the space of the view.
vec3 turnedToViewer( const in vec3 normal, const in vec3 position, const in float face ) {
	vec3 towardViewer = isOrthographic ? vec3( 0.0, 0.0, 1.0 ) : normalize( position );
	float normalLength = length( normal );
	if ( normalLength < 1e-6 ) {
		vec3 seen = cross( dFdx( position ), dFdy( position ) );
		float seenLength = length( seen );
		return seenLength > 0.0 ? seen / seenLength : towardViewer;
	}
	vec3 turned = normal * face / normalLength;
	float facing = dot( turned, towardViewer );
	return facing < 0.0 ? normalize( turned - ( facing - 1e-3 ) * towardViewer ) : turned;
}
`,
  normal_fragment_begin: edited('normal_fragment_begin', [
    ['normal *= faceDirection;', 'normal = turnedToViewer( vNormal, vViewPosition, faceDirection );'],
  ]),
};

/** A chunk of three.js with some of it replaced. @throws Error where three.js has changed and does not have it. */
function edited(chunk: keyof typeof ShaderChunk, edits: readonly (readonly [was: string, is: string])[]): string {
  let text: string = ShaderChunk[chunk];
  for (const [was, is] of edits) {
    if (!text.includes(was)) throw new Error(`three.js's shader chunk ${chunk} has no "${was}" to replace.`);
    text = text.replace(was, is);
  }
  return text;
}

/**
 * Makes any material skin exactly, and shade by normals turned toward the viewer: one for the surface, lines, shadow
 * (`customDepthMaterial`), an ID render. A shader of one's own includes three.js's chunks for skinning and morphs.
 * A material made for a skin with an `attachmentTexture` serves that skin only; without one it serves all such skins.
 */
export function withExactSkinning<M extends Material>(
  material: M,
  skin?: { readonly attachmentTexture: DataTexture | undefined },
): M {
  const texture = skin?.attachmentTexture;
  const before = material.onBeforeCompile;
  const keyBefore = material.customProgramCacheKey();
  const chunks = { ...skinningChunks(texture !== undefined), ...LIGHTING_CHUNKS };
  material.onBeforeCompile = (shader: WebGLProgramParametersWithUniforms, renderer: WebGLRenderer) => {
    before.call(material, shader, renderer);
    for (const [name, text] of Object.entries(chunks)) {
      // It alone has no `vViewPosition`; and it is for looking at normals, not for light.
      if (name === 'normal_fragment_begin' && material instanceof MeshNormalMaterial) continue;
      const include = `#include <${name}>`;
      shader.vertexShader = shader.vertexShader.replaceAll(include, text);
      shader.fragmentShader = shader.fragmentShader.replaceAll(include, text);
    }
    if (texture) shader.uniforms.attachmentTexture = { value: texture };
  };
  const key = `exact skinning${texture ? ', any number of attachments' : ''}; ${keyBefore}`;
  material.customProgramCacheKey = () => key;
  return material;
}

/**
 * Exact smooth skinning with three.js, in one place:
 *
 *     v′ = Σ wᵢ · Mᵢ · v          n′ = normalised Σ wᵢ · Mᵢ⁻ᵀ · n          Mᵢ = Wᵢ · Bᵢ⁻¹
 *
 * three.js's own skinning is right only for 1 to 4 attachments and rigid Mᵢ. The differences:
 *
 * - Bone matrices Mᵢ are in the character's space: `bindMatrix` is the identity and the mesh's `matrixWorld` is the
 *   placement, so one bone texture serves every placement, and weights that don't sum to 1 scale about the character's
 *   own origin, on the GPU and in `getVertexPosition` alike.
 * - The bone texture has one matrix more than there are joints, the identity. A vertex without attachments is bound to
 *   it and doesn't move; three.js moves it to the origin.
 * - The first four attachments are in the attributes `skinIndex` and `skinWeight`; further ones, any number of them,
 *   are pairs (joint, weight) in a texture, of which a vertex has the range `attachmentRange`. Only shaders of skins
 *   with such vertices read it.
 * - Normals are turned by the inverse transpose, which is the cofactor matrix over the determinant.
 * - `applyBoneTransform` computes the same in doubles.
 *
 * Rejected: two more pairs of attributes (eight attachments, but 9 occur), all attachments in the texture (another
 * dependent fetch for the usual four), and matrices relative to the root (exact far from the origin in floats too, but
 * wrong if weights don't sum to 1).
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
import { setIdentity } from '../../math/mat4.ts';
import type { Attachments, Skin } from '../../model/skin.ts';

/** A skin on the GPU: created once, shared by all placements and materials. */
export interface SkinGpu {
  readonly skin: Skin;
  readonly geometry: BufferGeometry;
  readonly skeleton: ExactSkeleton;
  /** Without a skeleton a skin isn't deformed, whatever its weights sum to. */
  readonly isPosed: boolean;
  /** Attachments past the fourth, if any: see `skin-geometry.ts`. */
  readonly attachmentTexture: DataTexture | undefined;
}

/** A skeleton whose bone matrices are given, in doubles, and end with the identity. */
export class ExactSkeleton extends Skeleton {
  /** Mᵢ, 16 numbers per joint, column-major, in the character's space; the identity after the last joint. */
  readonly matrices: Float64Array;
  override boneMatrices: Float32Array;
  override boneTexture: DataTexture;

  /**
   * @param jointCount at least as many as the skin's attachments refer to
   * @param inverseBindings 16 numbers per joint, for exporters; bones past its end get the identity
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

  /** Index of the identity matrix. */
  get identityIndex(): number {
    return this.matrices.length / 16 - 1;
  }

  /** Uploads `matrices` with the next draw. */
  upload(): void {
    this.boneMatrices.set(this.matrices);
    this.boneTexture.needsUpdate = true;
  }

  /** Called by three.js before drawing; `upload` has already done it. */
  override update(): void {}

  override computeBoneTexture(): this {
    return this;
  }

  /** Frees the texture on the GPU. (three.js would set it to null, and then fail on that.) */
  override dispose(): void {
    this.boneTexture.dispose();
  }
}

const point = new Vector4();

/** One placement of a skin. */
export class MarrowSkinnedMesh extends SkinnedMesh<BufferGeometry, Material | Material[]> {
  /**
   * @param sphere around the posed character, in its own space; kept by reference and updated by its owner, so that
   *   three.js neither iterates over the vertices nor culls by an old position
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

/** Σ wᵢ · Mᵢ · v in place, w kept as it is. A skin without attachments is bound to the root, joint 0. */
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

/** Lines that follow a skin like its surface. three.js skins anything with `isSkinnedMesh` and a skeleton. */
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

  /** Only the surface is picked. */
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

// m⁻ᵀ · n up to a factor. A singular matrix has no inverse; its cofactors still give the right direction.
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
export const forEachMore = (body: string) => /* glsl */ `
	for ( uint a = attachmentRange.x; a < attachmentRange.y; a ++ ) {
		vec2 attachment = getAttachment( a );
		${body}
	}
`;

/** three.js's skinning chunks, replaced. */
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
 * Lighting by the file's normals, turned toward the viewer. `facing.ts` has made normals agree with the winding, so the
 * visible side decides, once per triangle, as in three.js; under a mirroring matrix, the other side. Smooth normals
 * that still point away from the viewer, near a silhouette, are bent back until just perpendicular to the view, which
 * is continuous: no pixel is dark, and nothing jumps within a triangle. Without a normal (zero length, or neighbours
 * that cancel out) the geometric one is used, from the position's screen-space derivatives.
 *
 * Rejected: deciding per pixel by the geometric normal, which tears a triangle with one bad corner; flipping every
 * normal that points away, which gives silhouettes speckles lit from the wrong side.
 */
const LIGHTING_CHUNKS: Readonly<Record<string, string>> = {
  normal_pars_vertex: /* glsl */ `${ShaderChunk.normal_pars_vertex}
// 1 if the normal disagrees with the winding of its triangles; 0 if a geometry doesn't have it.
attribute float turned;
`,
  normal_vertex: edited('normal_vertex', [
    [
      'vNormal = normalize( transformedNormal );',
      `float transformedLength = length( transformedNormal );
	vNormal = transformedLength > 0.0 ? transformedNormal / transformedLength : vec3( 0.0 );
	vNormal *= 1.0 - 2.0 * turned;
#ifdef USE_SKINNING
	// Mirroring flips windings, but not normals.
	if ( determinant( mat3( boneMatX ) ) < 0.0 ) vNormal = - vNormal;
#endif`,
    ],
  ]),
  normal_pars_fragment: /* glsl */ `${ShaderChunk.normal_pars_fragment}
// A normal of any length turned toward the viewer; position is the negative of that in view space.
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

/** A three.js chunk with replacements. @throws Error if three.js has changed and no longer contains the text */
function edited(chunk: keyof typeof ShaderChunk, edits: readonly (readonly [was: string, is: string])[]): string {
  let text: string = ShaderChunk[chunk];
  for (const [was, is] of edits) {
    if (!text.includes(was)) throw new Error(`three.js's shader chunk ${chunk} has no "${was}" to replace.`);
    text = text.replace(was, is);
  }
  return text;
}

/**
 * Makes any material skin exactly, and shade by normals turned toward the viewer: surface, lines, shadow
 * (`customDepthMaterial`), ID render. Custom shaders include three.js's chunks for skinning and morphs. A material
 * created for a skin with an `attachmentTexture` serves that skin only; without one it serves all such skins.
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
      // It alone has no `vViewPosition`; and it shows normals, without lighting.
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

/**
 * Exact smooth skinning with three.js, in one place:
 *
 *     v′ = Σ wᵢ · Mᵢ · v          n′ = normalised Σ wᵢ · Mᵢ⁻ᵀ · n          Mᵢ = Wᵢ · Bᵢ⁻¹
 *
 * three.js's own skinning is right only for 1 to 4 attachments and rigid Mᵢ. The differences:
 *
 * - Bone matrices Mᵢ are in the character's space: `bindMatrix` is the identity and the mesh's `matrixWorld` is the
 *   placement, so one block of matrices serves every placement, and weights that don't sum to 1 scale about the
 *   character's own origin, on the GPU and in `getVertexPosition` alike.
 * - All characters' matrices are in one texture, the palette, uploaded once a frame: a block for each, followed by the
 *   weights of its morphs.
 * - A block has one matrix more than there are joints, the identity. A vertex without attachments is bound to it and
 *   doesn't move; three.js moves it to the origin.
 * - The first four attachments are in the attributes `skinIndex` and `skinWeight`; further ones, any number of them,
 *   are pairs (joint, weight) in a texture, of which a vertex has the range `attachmentRange`. Only shaders of skins
 *   with such vertices read it.
 * - Normals are turned by the inverse transpose, which is the cofactor matrix over the determinant.
 * - Equal skins are drawn as instances: see `drawn-skins.ts`. Morphs are summed in the vertex shader, before skinning:
 *   see `packed-morphs.ts`.
 * - `getVertexPosition` computes the same in doubles.
 *
 * Rejected: two more pairs of attributes (eight attachments, but 9 occur), all attachments in the texture (another
 * dependent fetch for the usual four), and matrices relative to the root (exact far from the origin in floats too, but
 * wrong if weights don't sum to 1).
 */
import {
  type DataTexture,
  type IUniform,
  type Material,
  MeshNormalMaterial,
  ShaderChunk,
  ShaderMaterial,
  type WebGLProgramParametersWithUniforms,
  type WebGLRenderer,
} from 'three';
import { type FloatBlocks, MATRIX_TEXELS, ROW_BITS } from './float-blocks.ts';
import { MORPH_ROW, type PackedMorphs } from './packed-morphs.ts';
import type { PaletteSkeleton } from './palette-skeleton.ts';
import { ATTACHMENT_ROW } from './skin-geometry.ts';

/** What of a skin is on the GPU, apart from vertices: created once for all characters with an equal one. */
export interface SkinData {
  /** Attachments past the fourth, if any: see `skin-geometry.ts`. */
  readonly attachmentTexture: DataTexture | undefined;
  readonly morphs: PackedMorphs | undefined;
}

/** A skin that is neither: a material for it serves all such skins. */
export const PLAIN_SKIN: SkinData = { attachmentTexture: undefined, morphs: undefined };

/** How many of a skin a material draws with one call. */
export type Placing =
  /** One, of a mesh with a matrix as usual; uniforms say where its block of the palette is: see `placeOne`. */
  | 'one'
  /** Instances: the attribute `placed` says where in the textures each one's block and matrices are. */
  | 'many';

/** Uniforms of a material that draws one, with others. */
interface OneUniforms {
  readonly firstMatrix: IUniform<number>;
  readonly firstWeight: IUniform<number>;
}

/** For a material that draws one: whose the next draw is. */
export function placeOne(material: ShaderMaterial, { firstMatrix, firstWeight }: PaletteSkeleton): void {
  // `withExactSkinning` has given it these.
  const uniforms = material.uniforms as unknown as OneUniforms;
  uniforms.firstMatrix.value = firstMatrix;
  uniforms.firstWeight.value = firstWeight;
  material.uniformsNeedUpdate = true;
}

const TEXEL_OF = /* glsl */ `
vec4 texelOf( const in highp sampler2D blocks, const in uint i ) {
	return texelFetch( blocks, ivec2( int( i & ${(1 << ROW_BITS) - 1}u ), int( i >> ${ROW_BITS}u ) ), 0 );
}

// By its rows: see FloatBlocks.
mat4 matrixOf( const in highp sampler2D blocks, const in uint i ) {
	return transpose( mat4(
		texelOf( blocks, i ), texelOf( blocks, i + 1u ), texelOf( blocks, i + 2u ), vec4( 0.0, 0.0, 0.0, 1.0 ) ) );
}
`;

const PLACED: Readonly<Record<Placing, string>> = {
  one: /* glsl */ `
uniform highp uint firstMatrix;
uniform highp uint firstWeight;
`,
  // Texels of the placement, and of matrices and weights in the palette; the joint whose influence is shown.
  many: /* glsl */ `
in uvec4 placed;
uniform highp sampler2D placementTexture;
#define firstMatrix placed.y
#define firstWeight placed.z

// To the view, and to the world: on the processor, in doubles, far from the origin too.
mat4 placementView() { return matrixOf( placementTexture, placed.x ); }
mat4 placementWorld() { return matrixOf( placementTexture, placed.x + ${MATRIX_TEXELS}u ); }
`,
};

const BONE_MATRIX = /* glsl */ `
uniform highp sampler2D boneTexture;

mat4 getBoneMatrix( const in float i ) {
	return matrixOf( boneTexture, firstMatrix + ${MATRIX_TEXELS}u * uint( i ) );
}

`;

const TURN_NORMAL = /* glsl */ `
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
	return texelFetch( attachmentTexture, ivec2( int( i % ${ATTACHMENT_ROW}u ), int( i / ${ATTACHMENT_ROW}u ) ), 0 ).xy;
}
`;

const MORPHS = /* glsl */ `
uniform highp sampler2D morphTexture;
in uvec2 morphRange;

vec4 getDifference( const in uint i ) {
	return texelFetch( morphTexture, ivec2( int( i % ${MORPH_ROW}u ), int( i / ${MORPH_ROW}u ) ), 0 );
}

float getMorphWeight( const in float m ) {
	uint i = uint( m );
	return texelOf( boneTexture, firstWeight + i / 4u )[ i % 4u ];
}
`;

/** Adds what `part` says of each of the vertex's differences: see `packed-morphs.ts`. */
const forEachDifference = (part: string) => /* glsl */ `
	for ( uint d = morphRange.x; d < morphRange.y; d ++ ) {
		vec4 difference = getDifference( 2u * d );
		float morphWeight = getMorphWeight( difference.x );
		if ( morphWeight != 0.0 ) ${part}
	}
`;

/** GLSL that sets `out` to a joint's weight on the vertex: the sum of its attachments. @param joint a float */
export function jointWeight(out: string, joint: string, { attachmentTexture }: SkinData): string {
  return /* glsl */ `{
		float joint = ${joint};
		${out} = dot( skinWeight, vec4( equal( skinIndex, vec4( joint ) ) ) );
		${attachmentTexture ? forEachMore(`${out} += attachment.x == joint ? attachment.y : 0.0;`) : ''}
	}`;
}

/** Runs `body` for each attachment past the fourth. */
const forEachMore = (body: string) => /* glsl */ `
	for ( uint a = attachmentRange.x; a < attachmentRange.y; a ++ ) {
		vec2 attachment = getAttachment( a );
		${body}
	}
`;

/** three.js's chunks of skinning, morphs and placement, replaced. */
function skinningChunks(
  { attachmentTexture, morphs }: SkinData,
  placing: Placing,
  throughWorld: boolean,
): Readonly<Record<string, string>> {
  const more = attachmentTexture !== undefined;
  return {
    // Before the chunk of skinning in all of three.js's materials.
    morphtarget_pars_vertex: `
#ifdef USE_SKINNING
${TEXEL_OF}${PLACED[placing]}${TURN_NORMAL}${BONE_MATRIX}${more ? MORE_ATTACHMENTS : ''}${morphs ? MORPHS : ''}
#endif
`,
    skinning_pars_vertex: '',
    ...(morphs?.moveNormals && {
      morphnormal_vertex: forEachDifference('objectNormal += morphWeight * getDifference( 2u * d + 1u ).xyz;'),
    }),
    ...(morphs && { morphtarget_vertex: forEachDifference('transformed += morphWeight * difference.yzw;') }),
    // What has no weight isn't read: most vertices have one or two attachments.
    skinbase_vertex: /* glsl */ `
#ifdef USE_SKINNING
	mat4 boneMatX = getBoneMatrix( skinIndex.x );
	mat4 boneMatY = skinWeight.y == 0.0 ? mat4( 0.0 ) : getBoneMatrix( skinIndex.y );
	mat4 boneMatZ = skinWeight.z == 0.0 ? mat4( 0.0 ) : getBoneMatrix( skinIndex.z );
	mat4 boneMatW = skinWeight.w == 0.0 ? mat4( 0.0 ) : getBoneMatrix( skinIndex.w );
	${placing === 'many' ? 'mat4 placedView = placementView();' : ''}
#endif
`,
    ...(placing === 'many' && {
      defaultnormal_vertex: edited('defaultnormal_vertex', [
        [
          'transformedNormal = normalMatrix * transformedNormal;',
          ifSkinned(
            'transformedNormal = turnNormal( placedView, transformedNormal );',
            'transformedNormal = normalMatrix * transformedNormal;',
          ),
        ],
      ]),
      project_vertex: edited('project_vertex', [
        [
          'mvPosition = modelViewMatrix * mvPosition;',
          ifSkinned(
            // The shadow's camera isn't the one the textures are for. The batch itself is at the origin.
            throughWorld
              ? 'mvPosition = modelViewMatrix * ( placementWorld() * mvPosition );'
              : 'mvPosition = placedView * mvPosition;',
            'mvPosition = modelViewMatrix * mvPosition;',
          ),
        ],
      ]),
    }),
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
const lightingChunks = (placing: Placing): Readonly<Record<string, string>> => ({
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
	${placing === 'many' ? 'if ( determinant( mat3( placedView ) ) < 0.0 ) vNormal = - vNormal;' : ''}
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
});

/** GLSL for what is skinned, and for what isn't. */
function ifSkinned(skinned: string, otherwise: string): string {
  return `\n#ifdef USE_SKINNING\n\t${skinned}\n#else\n\t${otherwise}\n#endif\n`;
}

/** A three.js chunk with replacements. @throws Error if three.js has changed and no longer contains the text */
function edited(chunk: keyof typeof ShaderChunk, edits: readonly (readonly [was: string, is: string])[]): string {
  let text: string = ShaderChunk[chunk];
  for (const [was, is] of edits) {
    if (!text.includes(was)) throw new Error(`three.js's shader chunk ${chunk} has no "${was}" to replace.`);
    text = text.replace(was, is);
  }
  return text;
}

/** How `withExactSkinning` changes a material. */
export interface SkinningOptions {
  readonly placing: Placing;
  /** With `many`: the placements and views of all instances. */
  readonly placements?: FloatBlocks | undefined;
  /** With `many`: for cameras other than that of the placements, as a shadow's. */
  readonly throughWorld?: boolean;
}

/**
 * Makes any material skin exactly, and shade by normals turned toward the viewer: surface, lines, shadow
 * (`customDepthMaterial`), ID render. Custom shaders include three.js's chunks for skinning and morphs. A material
 * created for a skin with textures serves that skin only; for `PLAIN_SKIN` it serves all without.
 */
export function withExactSkinning<M extends Material>(
  material: M,
  skin: SkinData,
  { placing, placements, throughWorld = false }: SkinningOptions,
): M {
  const { attachmentTexture, morphs } = skin;
  const before = material.onBeforeCompile;
  const keyBefore = material.customProgramCacheKey();
  const chunks = { ...skinningChunks(skin, placing, throughWorld), ...lightingChunks(placing) };
  const uniforms: Record<string, IUniform> = {
    ...(attachmentTexture && { attachmentTexture: { value: attachmentTexture } }),
    ...(morphs && { morphTexture: { value: morphs.texture } }),
    ...(placements && { placementTexture: { value: placements.texture } }),
  };
  if (placing === 'one' && material instanceof ShaderMaterial) {
    Object.assign(material.uniforms, { firstMatrix: { value: 0 }, firstWeight: { value: 0 } });
  }
  material.onBeforeCompile = (shader: WebGLProgramParametersWithUniforms, renderer: WebGLRenderer) => {
    before.call(material, shader, renderer);
    for (const [name, text] of Object.entries(chunks)) {
      // It alone has no `vViewPosition`; and it shows normals, without lighting.
      if (name === 'normal_fragment_begin' && material instanceof MeshNormalMaterial) continue;
      const include = `#include <${name}>`;
      shader.vertexShader = shader.vertexShader.replaceAll(include, text);
      shader.fragmentShader = shader.fragmentShader.replaceAll(include, text);
    }
    Object.assign(shader.uniforms, uniforms);
  };
  const morphing = morphs && (morphs.moveNormals ? 'morphs' : 'morphs of positions');
  const kinds = [placing, throughWorld && 'world', attachmentTexture && 'any attachments', morphing];
  const key = `exact skinning: ${kinds.filter(Boolean).join(', ')}; ${keyBefore}`;
  material.customProgramCacheKey = () => key;
  return material;
}

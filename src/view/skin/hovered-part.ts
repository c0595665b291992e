/**
 * Lights up the part of a skin that follows the hovered joint, by the joint's weights: computed from the attributes
 * that skin it, so that hovering changes one uniform and no buffer.
 */
import { Color, type Material } from 'three';
import { MATRIX_TEXELS } from './float-blocks.ts';
import { jointWeight, type SkinData } from './skinning.ts';

/** Share of the highlight in the colour of a vertex that follows only this joint, and its glow. */
const COLOUR_PART = 0.6;
const GLOW = 0.15;
/** Its index in a skin's own block; outside of it for another skin's joint. Rounded, since a GPU may divide inexactly. */
const JOINT = `round( ( hoveredMatrix - float( firstMatrix ) ) / ${MATRIX_TEXELS}.0 )`;
/** No joint. Far below all blocks. */
const NONE = -1e6;

/** Uniforms of the materials of all skins. */
export class HoveredPart {
  /** First texel in the palette of the joint's matrix; far below 0 for none. */
  readonly hoveredMatrix = { value: NONE };
  readonly hoveredColour = { value: new Color() };

  /** @param matrix first texel in the palette; undefined: no joint is hovered */
  show(matrix: number | undefined): void {
    this.hoveredMatrix.value = matrix ?? NONE;
  }
}

/**
 * Call before `withExactSkinning`, whose chunks it extends. The material's fragment shader has three.js's
 * `color_fragment`; with `emissivemap_fragment` the part also glows.
 */
export function withHoveredPart<M extends Material>(material: M, { ...uniforms }: HoveredPart, skin: SkinData): M {
  const before = material.onBeforeCompile;
  const keyBefore = material.customProgramCacheKey();
  material.onBeforeCompile = (shader, renderer) => {
    before.call(material, shader, renderer);
    Object.assign(shader.uniforms, uniforms);
    shader.vertexShader = shader.vertexShader
      .replace(
        '#include <skinning_pars_vertex>',
        '#include <skinning_pars_vertex>\nuniform float hoveredMatrix;\nout float vHovered;',
      )
      .replace(
        '#include <skinning_vertex>',
        /* glsl */ `#include <skinning_vertex>
	vHovered = 0.0;
#ifdef USE_SKINNING
	${jointWeight('vHovered', JOINT, skin)}
#endif`,
      );
    shader.fragmentShader = `uniform vec3 hoveredColour;\nin float vHovered;\n${shader.fragmentShader}`
      .replace(
        '#include <color_fragment>',
        /* glsl */ `#include <color_fragment>
	float hovered = clamp( vHovered, 0.0, 1.0 );
	diffuseColor = mix( diffuseColor, vec4( hoveredColour, 1.0 ), ${COLOUR_PART} * hovered );`,
      )
      .replace(
        '#include <emissivemap_fragment>',
        `#include <emissivemap_fragment>\n\ttotalEmissiveRadiance += ${GLOW} * hovered * hoveredColour;`,
      );
  };
  const key = `hovered part; ${keyBefore}`;
  material.customProgramCacheKey = () => key;
  return material;
}

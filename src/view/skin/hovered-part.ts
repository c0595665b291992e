/**
 * Lights up the part of a skin that follows the hovered joint, by the joint's weights: computed from the attributes that
 * skin it, so that hovering changes one uniform and no buffer.
 */
import { Color, type Material } from 'three';
import { forEachMore } from './skinning.ts';

/** Share of the highlight in the colour of a vertex that follows only this joint, and its glow. */
const COLOUR_PART = 0.6;
const GLOW = 0.15;

/** Uniforms, shared by the materials of a character's skin. */
export class HoveredPart {
  /** The joint's index; -1 for none. */
  readonly hoveredJoint = { value: -1 };
  readonly hoveredColour = { value: new Color() };
}

/**
 * Call before `withExactSkinning`, whose chunks it extends. The material's fragment shader has three.js's
 * `color_fragment`; with `emissivemap_fragment` the part also glows.
 *
 * @param more whether the skin has an `attachmentTexture`
 */
export function withHoveredPart<M extends Material>(material: M, { ...uniforms }: HoveredPart, more: boolean): M {
  const before = material.onBeforeCompile;
  const keyBefore = material.customProgramCacheKey();
  const each = more ? forEachMore('vHovered += attachment.x == hoveredJoint ? attachment.y : 0.0;') : '';
  material.onBeforeCompile = (shader, renderer) => {
    before.call(material, shader, renderer);
    Object.assign(shader.uniforms, uniforms);
    shader.vertexShader = shader.vertexShader
      .replace(
        '#include <skinning_pars_vertex>',
        '#include <skinning_pars_vertex>\nuniform float hoveredJoint;\nout float vHovered;',
      )
      .replace(
        '#include <skinning_vertex>',
        /* glsl */ `#include <skinning_vertex>
	vHovered = 0.0;
#ifdef USE_SKINNING
	vHovered = dot( skinWeight, vec4( equal( skinIndex, vec4( hoveredJoint ) ) ) );
	${each}
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
  const key = `hovered part${more ? ', any number of attachments' : ''}; ${keyBefore}`;
  material.customProgramCacheKey = () => key;
  return material;
}

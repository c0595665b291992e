/**
 * Materials of skins. Each skins exactly, draws both sides, and is lit by the file's normals turned toward the viewer;
 * see `skinning.ts`. Equal skins share them, in each colour; so do all that have neither morphs nor attachments past
 * the fourth. Compiled programs are shared anyway.
 */
import {
  Color,
  DoubleSide,
  LineBasicMaterial,
  type Material,
  MeshDepthMaterial,
  MeshStandardMaterial,
  ShaderMaterial,
  type Texture,
} from 'three';
import type { Vec3 } from '../../math/vec3.ts';
import type { FloatBlocks } from './float-blocks.ts';
import { heatRamp } from './heat.ts';
import { type HoveredPart, withHoveredPart } from './hovered-part.ts';
import type { SkinLook } from './skin-looks.ts';
import type { SkinTheme } from './skin-theme.ts';
import { jointWeight, type SkinData, withExactSkinning } from './skinning.ts';

/** What the materials of all skins have in common. */
export interface SkinUniforms {
  /** Of all instances. */
  readonly placements: FloatBlocks;
  readonly hovered: HoveredPart;
}

/** What a material was made for. */
interface Made {
  readonly material: Material;
  readonly kind: MaterialKind;
  readonly tint: string | undefined;
  readonly color?: Vec3 | undefined;
  readonly fade: number;
  /** A texture that others use too outlives this material, and must not keep it. */
  leaveTexture(): void;
}

type MaterialKind = 'solid' | 'textured' | 'heat' | 'xray' | 'wire' | 'normals' | 'depth';

/** The materials of equal skins, or of all that have no textures of their own; created on first use. */
export class SkinMaterials {
  private readonly made = new Map<string, Made>();

  /** @param uniforms undefined: for meshes that aren't skinned */
  constructor(
    private readonly skin: SkinData,
    private theme: SkinTheme,
    private readonly uniforms?: SkinUniforms,
  ) {}

  setTheme(theme: SkinTheme): void {
    this.theme = theme;
    for (const made of this.made.values()) this.paint(made);
  }

  /** @param tint a colour for the whole skin; undefined: its own */
  solid(tint?: string): Material {
    return this.get('solid', tint, clay);
  }

  /**
   * One material for each look, in their order; one with neither texture nor colour is that of the style solid.
   *
   * @param textures those that are decoded, by their names in looks
   */
  textured(
    looks: readonly SkinLook[],
    textures: ReadonlyMap<string, Texture>,
    tint?: string,
  ): Material | readonly Material[] {
    const all = looks.map(({ texture, color }) => {
      const map = texture === undefined ? undefined : textures.get(texture);
      if (!color && !map) return this.solid(tint);
      return this.get('textured', tint, () => Object.assign(clay(), { map: map ?? null }), map, color);
    });
    return all.length === 1 ? all[0] : all;
  }

  /** Heat map and normals have no tint, since their colours mean something. */
  heat(values?: Texture): Material {
    return this.get('heat', undefined, () => heat(this.skin, values), values);
  }

  /** @param fade factor of its opacity */
  xray(tint?: string, fade = 1): Material {
    return this.get('xray', tint, xray, undefined, undefined, fade);
  }

  wire(tint?: string): Material {
    return this.get('wire', tint, wire);
  }

  normals(): ShaderMaterial {
    // `normalLines` creates a ShaderMaterial, and a kind is always the same class of material.
    return this.get('normals', undefined, normalLines) as ShaderMaterial;
  }

  /** For shadows. */
  depth(): Material {
    return this.get('depth', undefined, () => new MeshDepthMaterial({ side: DoubleSide }));
  }

  dispose(): void {
    for (const made of this.made.values()) {
      made.material.dispose();
      made.leaveTexture();
    }
    this.made.clear();
  }

  /** @param texture that it is made of: it ends with it */
  private get(
    kind: MaterialKind,
    tint: string | undefined,
    make: () => Material,
    texture?: Texture,
    color?: Vec3,
    fade = 1,
  ): Material {
    const name = [kind, tint, texture?.uuid, color, fade].join(' ');
    const known = this.made.get(name);
    if (known) return known.material;
    const { skin, uniforms } = this;
    const material = make();
    if (uniforms && LIGHTS_UP.has(kind)) withHoveredPart(material, uniforms.hovered, skin);
    withExactSkinning(material, skin, {
      placing: kind === 'normals' ? 'one' : 'many',
      placements: uniforms?.placements,
      throughWorld: kind === 'depth',
    });
    material.name = `skin ${kind}`;
    const end = () => {
      material.dispose();
      this.made.delete(name);
    };
    texture?.addEventListener('dispose', end);
    const leaveTexture = () => texture?.removeEventListener('dispose', end);
    const made = { material, kind, tint, color, fade, leaveTexture };
    this.made.set(name, made);
    this.paint(made);
    return material;
  }

  private paint({ material, kind, tint, color, fade }: Made): void {
    const { theme } = this;
    if (material instanceof MeshStandardMaterial && kind === 'solid') dye(material.color.set(theme.clay), tint);
    if (material instanceof MeshStandardMaterial && kind === 'textured') {
      dye(material.color.setRGB(...(color ?? WHITE)), tint);
    }
    if (material instanceof LineBasicMaterial) {
      material.color.set(tint ?? theme.wire);
      material.opacity = theme.wireOpacity;
    }
    if (material instanceof ShaderMaterial && kind === 'xray') {
      material.uniforms.colour.value.set(tint ?? theme.xray);
      material.uniforms.facing.value = theme.xrayFacing * fade;
      material.uniforms.edge.value = theme.xrayEdge * fade;
    }
    if (material instanceof ShaderMaterial && kind === 'normals') material.uniforms.colour.value.set(theme.normals);
  }
}

/** Materials that highlight the hovered joint's part; in the others colours mean something else. */
const LIGHTS_UP: ReadonlySet<MaterialKind> = new Set(['solid', 'textured', 'xray', 'wire']);

/** Share of the tint in a skin's colour, so that shape and texture stay visible. */
const TINT_PART = 0.6;
const scratch = new Color();

const WHITE: Vec3 = [1, 1, 1];

function dye(colour: Color, tint: string | undefined): void {
  if (tint) colour.lerp(scratch.set(tint), TINT_PART);
}

/** Matte, with just enough gloss to tell a ridge from a stripe. */
function clay(): MeshStandardMaterial {
  return new MeshStandardMaterial({ side: DoubleSide, roughness: 0.72, metalness: 0 });
}

/**
 * A value per vertex as a colour, slightly lit, so that the shape is readable.
 *
 * @param values from 0 to 1, one texel each; undefined: the weight of the joint that each instance says
 */
function heat(skin: SkinData, values: Texture | undefined): MeshStandardMaterial {
  const material = new MeshStandardMaterial({ side: DoubleSide, roughness: 1, metalness: 0 });
  const influence = values
    ? `uint width = uint( textureSize( heatValues, 0 ).x );
	vInfluence = texelFetch( heatValues, ivec2( gl_VertexID % int( width ), gl_VertexID / int( width ) ), 0 ).x;`
    : jointWeight('vInfluence', 'float( placed.w )', skin);
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, {
      heatRamp: { value: heatRamp() },
      ...(values && { heatValues: { value: values } }),
    });
    shader.vertexShader = shader.vertexShader
      .replace(
        '#include <skinning_pars_vertex>',
        `#include <skinning_pars_vertex>\n${values ? 'uniform highp sampler2D heatValues;\n' : ''}out float vInfluence;`,
      )
      .replace('#include <begin_vertex>', `#include <begin_vertex>\n\t${influence}`);
    shader.fragmentShader = shader.fragmentShader
      .replace('#include <common>', '#include <common>\nuniform sampler2D heatRamp;\nin float vInfluence;')
      .replace(
        '#include <color_fragment>',
        // From the centre of the first texel to that of the last.
        '\tdiffuseColor.rgb = texture2D( heatRamp, vec2( clamp( vInfluence, 0.0, 1.0 ) * ( 255.0 / 256.0 ) + 0.5 / 256.0, 0.5 ) ).rgb;',
      )
      // Half emissive: shading would darken colours that mean something.
      .replace('#include <emissivemap_fragment>', '\ttotalEmissiveRadiance += 0.45 * diffuseColor.rgb;');
  };
  const key = `heat of ${values ? 'values' : 'weights'}`;
  material.customProgramCacheKey = () => key;
  return material;
}

/** Edges of the mesh, unlit. */
function wire(): LineBasicMaterial {
  return new LineBasicMaterial({ transparent: true });
}

/** Clear head-on and denser towards its silhouette, like glass; bones show through. */
function xray(): ShaderMaterial {
  return new ShaderMaterial({
    transparent: true,
    depthWrite: false,
    side: DoubleSide,
    forceSinglePass: true,
    uniforms: { colour: { value: new Color() }, facing: { value: 0.1 }, edge: { value: 0.8 } },
    vertexShader: /* glsl */ `
#include <common>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
varying vec3 vViewPosition;
void main() {
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	vViewPosition = - mvPosition.xyz;
}`,
    fragmentShader: /* glsl */ `
uniform vec3 colour;
uniform float facing;
uniform float edge;
varying vec3 vViewPosition;
#include <common>
#include <normal_pars_fragment>
void main() {
	#include <normal_fragment_begin>
	vec3 toViewer = isOrthographic ? vec3( 0.0, 0.0, 1.0 ) : normalize( vViewPosition );
	float rim = pow( 1.0 - abs( dot( normal, toViewer ) ), 2.5 );
	vec4 diffuseColor = vec4( colour, mix( facing, edge, rim ) );
	#include <color_fragment>
	gl_FragColor = diffuseColor;
	#include <colorspace_fragment>
}`,
  });
}

/** A line from each vertex, which is the instance, along its normal: see `normalsGeometry`. */
function normalLines(): ShaderMaterial {
  return new ShaderMaterial({
    uniforms: { colour: { value: new Color() }, normalLength: { value: 1 } },
    vertexShader: /* glsl */ `
uniform float normalLength;
#include <common>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
void main() {
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	if ( gl_VertexID == 1 ) transformed += normalLength * objectNormal;
	#include <project_vertex>
}`,
    fragmentShader: /* glsl */ `
uniform vec3 colour;
#include <common>
void main() {
	gl_FragColor = vec4( colour, 1.0 );
	#include <colorspace_fragment>
}`,
  });
}

/**
 * Materials of skins. Each skins exactly, draws both sides, and is lit by the file's normals turned toward the viewer;
 * see `skinning.ts`.
 *
 * Each character has its own materials, for its texture, its attachments past the fourth and the length of its normals;
 * compiled programs are shared.
 */
import {
  Color,
  DoubleSide,
  LineBasicMaterial,
  type Material,
  MeshDepthMaterial,
  MeshDistanceMaterial,
  MeshStandardMaterial,
  ShaderChunk,
  ShaderMaterial,
  type Texture,
} from 'three';
import type { Vec3 } from '../../math/vec3.ts';
import { heatRamp } from './heat.ts';
import { type HoveredPart, withHoveredPart } from './hovered-part.ts';
import type { SkinLook } from './skin-looks.ts';
import type { SkinTheme } from './skin-theme.ts';
import { type SkinGpu, withExactSkinning } from './skinning.ts';

/** The materials of one skin, created on first use. */
export class SkinMaterials {
  private readonly made = new Map<string, Material>();
  private textures: ReadonlyMap<string, Texture> = new Map();
  private readonly looks = new Map<Material, SkinLook>();
  private tint: string | undefined;

  constructor(
    private readonly skin: Pick<SkinGpu, 'attachmentTexture'>,
    private theme: SkinTheme,
    private readonly hovered: HoveredPart,
  ) {}

  setTheme(theme: SkinTheme): void {
    this.theme = theme;
    for (const [name, material] of this.made) this.paint(name, material);
  }

  /**
   * A colour for the whole skin; undefined: its own. Heat map and normals ignore it, since their colours mean
   * something.
   */
  setTint(tint: string | undefined): void {
    this.tint = tint;
    for (const [name, material] of this.made) this.paint(name, material);
  }

  /** Those that are decoded, by their names in looks. */
  setTextures(textures: ReadonlyMap<string, Texture>): void {
    this.textures = textures;
    for (const [name, material] of this.made) this.paint(name, material);
  }

  solid(): Material {
    return this.get('solid', clay);
  }

  /** One material for each look, in their order; one with neither texture nor colour is that of the style solid. */
  textured(looks: readonly SkinLook[]): Material | Material[] {
    const all = looks.map((look) => this.lookMaterial(look));
    return all.length === 1 ? all[0] : all;
  }

  heat(): Material {
    return this.get('heat', heat);
  }

  xray(): Material {
    return this.get('xray', xray);
  }

  wire(): Material {
    return this.get('wire', wire);
  }

  normals(): ShaderMaterial {
    // `normalLines` creates a ShaderMaterial, and a name always means the same kind of material.
    return this.get('normals', normalLines) as ShaderMaterial;
  }

  depth(): Material {
    return this.get('depth', () => new MeshDepthMaterial({ side: DoubleSide }));
  }

  distance(): Material {
    return this.get('distance', () => new MeshDistanceMaterial({ side: DoubleSide }));
  }

  dispose(): void {
    for (const material of this.made.values()) material.dispose();
    this.made.clear();
  }

  private lookMaterial(look: SkinLook): Material {
    const { texture, color } = look;
    if (!color && (texture === undefined || !this.textures.has(texture))) return this.solid();
    return this.get(`textured ${JSON.stringify(look)}`, () => {
      const material = clay();
      this.looks.set(material, look);
      return material;
    });
  }

  private get(name: string, make: () => Material): Material {
    let material = this.made.get(name);
    if (!material) {
      material = make();
      if (LIGHTS_UP.has(name.split(' ')[0]))
        withHoveredPart(material, this.hovered, this.skin.attachmentTexture !== undefined);
      withExactSkinning(material, this.skin);
      material.name = `skin ${name}`;
      this.made.set(name, material);
      this.paint(name, material);
    }
    return material;
  }

  private paint(name: string, material: Material): void {
    const { theme, tint } = this;
    const look = this.looks.get(material);
    if (material instanceof MeshStandardMaterial && name === 'solid') dye(material.color.set(theme.clay), tint);
    if (material instanceof MeshStandardMaterial && look) {
      const had = material.map !== null;
      material.map = (look.texture !== undefined && this.textures.get(look.texture)) || null;
      dye(material.color.setRGB(...(look.color ?? WHITE)), tint);
      if (had !== (material.map !== null)) material.needsUpdate = true;
    }
    if (material instanceof LineBasicMaterial) {
      material.color.set(tint ?? theme.wire);
      material.opacity = theme.wireOpacity;
    }
    if (material instanceof ShaderMaterial && name === 'xray') {
      material.uniforms.colour.value.set(tint ?? theme.xray);
      material.uniforms.facing.value = theme.xrayFacing;
      material.uniforms.edge.value = theme.xrayEdge;
    }
    if (material instanceof ShaderMaterial && name === 'normals') material.uniforms.colour.value.set(theme.normals);
  }
}

/** Materials that highlight the hovered joint's part; in the others colours mean something else. */
const LIGHTS_UP = new Set(['solid', 'textured', 'xray', 'wire']);

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

/** The weight as a colour, slightly lit, so that the shape is readable. */
function heat(): MeshStandardMaterial {
  const material = new MeshStandardMaterial({ side: DoubleSide, roughness: 1, metalness: 0 });
  material.onBeforeCompile = (shader) => {
    shader.uniforms.heatRamp = { value: heatRamp() };
    shader.vertexShader = shader.vertexShader
      .replace('#include <common>', '#include <common>\nin float influence;\nout float vInfluence;')
      .replace('#include <begin_vertex>', '#include <begin_vertex>\n\tvInfluence = influence;');
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

/**
 * A line from each vertex along its normal: see `normalsGeometry`. Morphs are indexed by the instance, which is the
 * vertex.
 */
function normalLines(): ShaderMaterial {
  const byInstance = (text: string) => text.replaceAll('gl_VertexID', 'gl_InstanceID');
  return new ShaderMaterial({
    uniforms: { colour: { value: new Color() }, normalLength: { value: 1 } },
    vertexShader: /* glsl */ `
uniform float normalLength;
#include <common>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
void main() {
	#include <beginnormal_vertex>
	MORPH_NORMAL
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <begin_vertex>
	MORPH_POSITION
	#include <skinning_vertex>
	if ( gl_VertexID == 1 ) transformed += normalLength * objectNormal;
	#include <project_vertex>
}`
      .replace('MORPH_NORMAL', byInstance(ShaderChunk.morphnormal_vertex))
      .replace('MORPH_POSITION', byInstance(ShaderChunk.morphtarget_vertex)),
    fragmentShader: /* glsl */ `
uniform vec3 colour;
#include <common>
void main() {
	gl_FragColor = vec4( colour, 1.0 );
	#include <colorspace_fragment>
}`,
  });
}

/**
 * The scene around characters: background, lights and the shadow on the ground.
 *
 *     key    warm, from above left, casts the shadow
 *     rim    cool, from behind right: lights the outline
 *     sky    soft from above, warm from the ground
 *     fill   faint, from the camera: no side of a character is too dark
 *
 * The shadow hardens on contact: casters close to the ground give a dark, sharp shadow, higher ones a wide and faint
 * one. Both come from one shadow map, sampled narrow and wide, the wide samples only from casters far above the ground.
 * The map is fitted to the characters, so their size doesn't matter.
 */
import {
  Box3,
  BufferAttribute,
  BufferGeometry,
  type Camera,
  Color,
  DirectionalLight,
  Group,
  HemisphereLight,
  type IUniform,
  Line,
  type Material,
  Mesh,
  NeutralToneMapping,
  PCFShadowMap,
  PlaneGeometry,
  Points,
  Scene,
  ShaderMaterial,
  ShadowMaterial,
  Skeleton,
  Sphere,
  Texture,
  Vector3,
  type WebGLRenderer,
} from 'three';
import type { StageTheme } from './theme.ts';
import { rawColor } from './thick-lines.ts';

/** Directions towards the lights. */
const KEY = new Vector3(-0.24, 1, 0.72).normalize();
const RIM = new Vector3(0.62, 0.55, -0.85).normalize();

/** Side of the shadow map in pixels. */
const SHADOW_MAP = 2048;
/**
 * The shadow covers this many times the distance from the camera to its target, around that: beside a giant, a small
 * character that is framed has one too.
 */
const SHADOW_REACH = 2;
/** The fitted size changes in these steps, so that edges don't crawl while a character moves. */
const SIZE_STEP = 1.2;

export class Stage {
  readonly scene = new Scene();
  /** Parent of the characters. */
  readonly content = new Group();
  private readonly key = new DirectionalLight('#ffe9d0', 2.3);
  private readonly rim = new DirectionalLight('#aecbff', 1.9);
  private readonly fill = new DirectionalLight('#f4f6ff', 0.8);
  private readonly sky = new HemisphereLight('#e6eeff', '#b8b0a8', 1.45);
  private readonly background = createBackground();
  private readonly ground = new Mesh(new PlaneGeometry(1, 1).rotateX(-Math.PI / 2), createShadowMaterial());
  private readonly sphere = new Sphere();
  private readonly right = new Vector3();
  private readonly up = new Vector3();
  private readonly centre = new Vector3();
  private readonly near = new Box3();

  constructor(renderer: WebGLRenderer) {
    renderer.toneMapping = NeutralToneMapping;
    renderer.shadowMap.enabled = true;
    renderer.shadowMap.type = PCFShadowMap;
    const { key, rim, fill, sky, ground } = this;
    key.castShadow = true;
    key.shadow.mapSize.set(SHADOW_MAP, SHADOW_MAP);
    key.shadow.radius = 2.5;
    key.shadow.intensity = 0.85;
    rim.position.copy(RIM);
    ground.receiveShadow = true;
    ground.renderOrder = -30;
    ground.frustumCulled = false;
    this.scene.add(this.background, this.content, ground, key, key.target, rim, fill, fill.target, sky);
    this.right.crossVectors(new Vector3(0, 1, 0), KEY).normalize();
    this.up.crossVectors(KEY, this.right);
  }

  setTheme(theme: StageTheme, renderer: WebGLRenderer): void {
    renderer.toneMappingExposure = theme.exposure;
    const { uniforms } = this.background.material;
    uniforms.top.value.copy(rawColor(theme.backgroundTop));
    uniforms.bottom.value.copy(rawColor(theme.backgroundBottom));
    this.ground.material.color.set(theme.shadow);
    this.ground.material.opacity = theme.shadowOpacity;
  }

  /** Without it pictures are transparent. */
  setBackground(on: boolean, renderer: WebGLRenderer): void {
    this.background.visible = on;
    renderer.setClearAlpha(on ? 1 : 0);
  }

  setShadow(on: boolean): void {
    this.ground.visible = on;
    this.key.castShadow = on;
  }

  /** Call before each frame: moves the fill light to the camera. */
  light(camera: Camera): void {
    const { fill } = this;
    fill.target.position.set(0, 0, 0);
    fill.position.setFromMatrixColumn(camera.matrixWorld, 2).addScaledVector(this.up, 0);
  }

  /**
   * Fits the shadow to `box`, its casters in the world, as far as they are near what the camera looks at. The map is a
   * square perpendicular to the light, in the depth from the casters' nearest point to where the light meets the ground
   * below them.
   */
  fitShadow(box: Box3, target: Vector3, distance: number): void {
    const { key, ground, sphere, centre, near } = this;
    if (!key.castShadow || box.isEmpty()) {
      ground.visible = false;
      return;
    }
    ground.visible = true;
    near.setFromCenterAndSize(target, centre.setScalar(2 * SHADOW_REACH * distance)).intersect(box);
    (near.isEmpty() ? box : near).getBoundingSphere(sphere);
    const radius = SIZE_STEP ** Math.ceil(Math.log(Math.max(sphere.radius, 1e-9) * 1.08) / Math.log(SIZE_STEP));
    // Snapped to whole texels, for the same reason.
    const texel = (2 * radius) / SHADOW_MAP;
    const a = Math.round(sphere.center.dot(this.right) / texel) * texel;
    const b = Math.round(sphere.center.dot(this.up) / texel) * texel;
    centre.set(0, 0, 0).addScaledVector(this.right, a).addScaledVector(this.up, b);
    centre.addScaledVector(KEY, sphere.center.dot(KEY));

    // Maximum horizontal distance of the shadow of the box's highest point; ground below that gets none.
    const fall = Math.max(0, centre.y + radius) / KEY.y;
    const camera = key.shadow.camera;
    camera.left = camera.bottom = -radius;
    camera.right = camera.top = radius;
    camera.near = 0;
    camera.far = 2 * radius + fall;
    camera.updateProjectionMatrix();
    key.target.position.copy(centre);
    key.position.copy(centre).addScaledVector(KEY, radius);
    key.shadow.normalBias = 2.5 * texel;
    key.shadow.bias = -texel / camera.far;

    // Where the light through the box's centre meets the ground.
    const reach = radius / KEY.y;
    const down = centre.y / KEY.y;
    ground.position.copy(centre).addScaledVector(KEY, -down);
    ground.position.y = 0;
    ground.scale.setScalar(2.3 * reach);
    const shader = ground.material.userData.uniforms;
    // Height above the ground that counts as far, as a part of the map's depth: half a "foot" of the box's height.
    shader.lifted.value = (0.07 * radius) / KEY.y / camera.far;
  }

  /** Gives back what three.js keeps of everything drawn: it goes on listening for its disposal after a lost context. */
  forget(renderer: WebGLRenderer): void {
    this.scene.traverse((object) => {
      if (!(object instanceof Mesh || object instanceof Line || object instanceof Points)) return;
      object.geometry.dispose();
      if ('skeleton' in object && object.skeleton instanceof Skeleton) object.skeleton.boneTexture?.dispose();
      for (const material of [object.material].flat()) {
        for (const texture of texturesOf(renderer, material)) texture.dispose();
        material.dispose();
      }
    });
    this.key.shadow.dispose();
  }

  dispose(): void {
    for (const mesh of [this.background, this.ground]) {
      mesh.geometry.dispose();
      mesh.material.dispose();
    }
    this.key.dispose();
  }
}

/** The textures of a material's program, with those that three.js itself gives it. */
function texturesOf({ properties }: WebGLRenderer, material: Material): readonly Texture[] {
  // Untyped in three.js; without a program there are none.
  const { uniforms = {} } = properties.get(material) as { readonly uniforms?: Readonly<Record<string, IUniform>> };
  return Object.values(uniforms).flatMap(({ value }) => (value instanceof Texture ? [value] : []));
}

/** A gradient behind everything, slightly lighter in the centre, dithered against banding. */
function createBackground(): Mesh<BufferGeometry, ShaderMaterial> {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]), 3));
  const material = new ShaderMaterial({
    depthTest: false,
    depthWrite: false,
    toneMapped: false,
    uniforms: { top: { value: new Color() }, bottom: { value: new Color() } },
    vertexShader: /* glsl */ `
      varying vec2 vAt;
      void main() {
        vAt = position.xy;
        gl_Position = vec4(position.xy, 1.0, 1.0);
      }
    `,
    fragmentShader: /* glsl */ `
      uniform vec3 top;
      uniform vec3 bottom;
      varying vec2 vAt;
      void main() {
        float height = smoothstep(-1.1, 1.0, vAt.y);
        vec3 color = mix(bottom, top, height);
        color += 0.022 * (1.0 - smoothstep(0.0, 1.3, length(vAt * vec2(0.9, 1.0))));
        // Interleaved gradient noise (Jimenez 2014).
        float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
        gl_FragColor = vec4(color + (noise - 0.5) / 255.0, 1.0);
      }
    `,
  });
  const mesh = new Mesh(geometry, material);
  mesh.frustumCulled = false;
  mesh.renderOrder = -1000;
  return mesh;
}

/** three.js's ShadowMaterial with our own shadow sampling. */
function createShadowMaterial(): ShadowMaterial {
  const material = new ShadowMaterial({
    depthWrite: false,
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 6,
  });
  const uniforms = { lifted: { value: 0.05 } };
  material.userData.uniforms = uniforms;
  material.toneMapped = false;
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, uniforms);
    shader.fragmentShader = shader.fragmentShader
      .replace(
        'void main() {',
        /* glsl */ `
        uniform float lifted;

        #if defined(USE_SHADOWMAP) && NUM_DIR_LIGHT_SHADOWS > 0
        // Part of a disc around the pixel's place in the map that is dark, for casters nearer to the light than z.
        float darkness(vec3 at, float radius, float phi) {
          float lit = 0.0;
          for (int i = 0; i < 20; i++) {
            lit += texture(directionalShadowMap[0], vec3(at.xy + vogelDiskSample(i, 20, phi) * radius, at.z));
          }
          return 1.0 - lit / 20.0;
        }

        float groundShadow() {
          vec3 at = vDirectionalShadowCoord[0].xyz / vDirectionalShadowCoord[0].w;
          float edge = length(at.xy * 2.0 - 1.0);
          if (edge >= 1.0) return 0.0;
          float phi = interleavedGradientNoise(gl_FragCoord.xy) * PI2;
          at.z = min(at.z - 0.0005, 1.0);
          float narrow = darkness(at, 0.006, phi);
          float wide = darkness(at, 0.035, phi);
          float high = darkness(vec3(at.xy, at.z - lifted), 0.012, phi);
          float contact = max(narrow - high, 0.0);
          return (0.62 * wide + 0.5 * contact + 0.12 * narrow) * (1.0 - smoothstep(0.9, 1.0, edge));
        }
        #else
        float groundShadow() { return 0.0; }
        #endif

        void main() {`,
      )
      .replace('( 1.0 - getShadowMask() )', 'groundShadow()');
  };
  return material;
}

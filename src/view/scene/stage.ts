/**
 * The scene around characters: background, lights and the shadow on the ground.
 *
 *     key    warm, from above left, casts the shadow
 *     rim    cool, from behind right of the camera's view: lights the outline, whichever side is seen
 *     sky    soft from above, warm from the ground
 *     fill   soft, from beside the camera: no side of a character is too dark
 *
 * The shadow hardens on contact: casters close to the ground give a dark, sharp shadow, higher ones a wide and faint
 * one. Both come from one shadow map, sampled narrow and wide, the wide samples only from casters far above the ground.
 * The map is fitted to the characters, so their size doesn't matter.
 */
import {
  Box3,
  BufferAttribute,
  BufferGeometry,
  Color,
  CustomBlending,
  DirectionalLight,
  Group,
  HemisphereLight,
  type IUniform,
  Line,
  type Material,
  Mesh,
  NeutralToneMapping,
  OneFactor,
  OneMinusSrcAlphaFactor,
  type OrthographicCamera,
  PCFShadowMap,
  type PerspectiveCamera,
  PlaneGeometry,
  Points,
  Scene,
  ShaderMaterial,
  ShadowMaterial,
  Skeleton,
  Sphere,
  SrcAlphaFactor,
  Texture,
  Vector3,
  type WebGLRenderer,
} from 'three';
import type { StageTheme } from '../theme.ts';
import { rawColor } from './thick-lines.ts';

/** Directions towards the lights. */
const KEY = new Vector3(-0.24, 1, 0.72).normalize();
/** The same along the camera's axes: to its right, up, and towards it from its target. */
const RIM = new Vector3(0.62, 0.5, -0.78).normalize();
const FILL = new Vector3(0.45, 0.25, 1).normalize();

/** Of the floor, before the characters and without depth test: nothing of it is ever drawn over a body. */
const SHADOW_ORDER = -850;

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
  /** Throws the shadow. */
  readonly key = new DirectionalLight('#fff0de', 2);
  private readonly rim = new DirectionalLight('#b9d2ff', 2.4);
  private readonly fill = new DirectionalLight('#fff4e8', 0.95);
  private readonly sky = new HemisphereLight('#eaf0ff', '#cfc6bb', 1.5);
  /** World height of the ground that gets the shadow. */
  floor = 0;
  private readonly background = createBackground();
  private readonly ground = new Mesh(new PlaneGeometry(1, 1).rotateX(-Math.PI / 2), createShadowMaterial());
  private readonly sphere = new Sphere();
  private readonly right = new Vector3();
  private readonly up = new Vector3();
  private readonly centre = new Vector3();
  private readonly near = new Box3();
  private readonly away = new Vector3();
  /** Centre, radius and depth that the shadow map was last fitted to. */
  private readonly fitted = new Vector3();
  private fittedRadius = 0;
  private fittedDepth = 0;
  /** Set before each frame: the renderer may draw other stages, too. */
  private exposure = 1;
  private clearAlpha = 1;
  private haveCastersMoved = true;

  constructor(private readonly renderer: WebGLRenderer) {
    renderer.toneMapping = NeutralToneMapping;
    renderer.shadowMap.enabled = true;
    renderer.shadowMap.type = PCFShadowMap;
    // Drawn again when something that throws it has moved, not when only the camera has.
    renderer.shadowMap.autoUpdate = false;
    const { key, rim, fill, sky, ground } = this;
    key.castShadow = true;
    key.shadow.mapSize.set(SHADOW_MAP, SHADOW_MAP);
    key.shadow.radius = 2.5;
    key.shadow.intensity = 0.85;
    ground.receiveShadow = true;
    ground.renderOrder = SHADOW_ORDER;
    ground.frustumCulled = false;
    this.scene.add(this.background, this.content, ground, key, key.target, rim, fill, sky);
    this.right.crossVectors(new Vector3(0, 1, 0), KEY).normalize();
    this.up.crossVectors(KEY, this.right);
  }

  setTheme(theme: StageTheme): void {
    this.exposure = theme.exposure;
    const { uniforms } = this.background.material;
    uniforms.top.value.copy(rawColor(theme.backgroundTop));
    uniforms.haze.value.copy(rawColor(theme.horizon));
    uniforms.bottom.value.copy(rawColor(theme.backgroundBottom));
    uniforms.vignette.value = theme.vignette;
    this.ground.material.color.set(theme.shadow);
    this.ground.material.opacity = theme.shadowOpacity;
  }

  /** Without it pictures are transparent. */
  setBackground(on: boolean): void {
    this.background.visible = on;
    this.clearAlpha = on ? 1 : 0;
  }

  setShadow(on: boolean): void {
    this.ground.visible = on;
    this.key.castShadow = on;
    this.moveCasters();
  }

  /** What throws shadows isn't where it was, or looks different: they are drawn again with the next frame. */
  moveCasters(): void {
    this.haveCastersMoved = true;
  }

  /** Call before each frame, last. */
  begin(): void {
    const { renderer } = this;
    renderer.toneMappingExposure = this.exposure;
    renderer.setClearAlpha(this.clearAlpha);
    renderer.shadowMap.needsUpdate = this.haveCastersMoved;
    this.haveCastersMoved = false;
  }

  /** Call before each frame: rim, fill and horizon go with the camera. */
  light(camera: PerspectiveCamera | OrthographicCamera): void {
    // Lights shine towards the origin, where their targets stay.
    this.rim.position.copy(RIM).transformDirection(camera.matrixWorld);
    this.fill.position.copy(FILL).transformDirection(camera.matrixWorld);
    this.background.material.uniforms.horizon.value = horizonOf(camera);
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
    const fall = Math.max(0, centre.y - this.floor + radius) / KEY.y;
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

    if (!this.fitted.equals(centre) || radius !== this.fittedRadius || camera.far !== this.fittedDepth) {
      this.fitted.copy(centre);
      this.fittedRadius = radius;
      this.fittedDepth = camera.far;
      this.moveCasters();
    }

    // Where the light through the box's centre meets the ground.
    const reach = radius / KEY.y;
    const down = (centre.y - this.floor) / KEY.y;
    ground.position.copy(centre).addScaledVector(KEY, -down);
    ground.position.y = this.floor;
    ground.scale.setScalar(2.3 * reach);
    const shader = ground.material.userData.uniforms;
    // Height above the ground that counts as far, as a part of the map's depth: half a "foot" of the box's height.
    shader.lifted.value = (0.07 * radius) / KEY.y / camera.far;
  }

  /** Whether what is inside of a sphere may throw a shadow on the ground that is drawn. */
  readonly mayCast = ({ center, radius }: Sphere): boolean => {
    if (!this.ground.visible) return false;
    const { left, right } = this.key.shadow.camera;
    const reach = (right - left) / 2 + radius;
    const from = this.away.subVectors(center, this.key.target.position);
    return Math.abs(from.dot(this.right)) <= reach && Math.abs(from.dot(this.up)) <= reach;
  };

  /** See `ShownDocument.forget`. */
  forget(): void {
    const { renderer } = this;
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

/** Where the horizon is without one: above anything that is seen. */
const NO_HORIZON = 3;

/** Height of the horizon in the picture, from -1 at the bottom to 1 at the top. */
function horizonOf(camera: PerspectiveCamera | OrthographicCamera): number {
  if (!('isPerspectiveCamera' in camera)) return NO_HORIZON;
  const m = camera.matrixWorld.elements;
  const slope = m[9] / Math.hypot(m[8], m[10]);
  return Math.min(NO_HORIZON, Math.max(-NO_HORIZON, slope * camera.projectionMatrix.elements[5]));
}

/** A haze at the horizon that fades upwards and downwards, behind everything, dithered against banding. */
function createBackground(): Mesh<BufferGeometry, ShaderMaterial> {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]), 3));
  const material = new ShaderMaterial({
    depthTest: false,
    depthWrite: false,
    toneMapped: false,
    uniforms: {
      top: { value: new Color() },
      haze: { value: new Color() },
      bottom: { value: new Color() },
      horizon: { value: 0 },
      vignette: { value: 0 },
    },
    vertexShader: /* glsl */ `
      varying vec2 vAt;
      void main() {
        vAt = position.xy;
        gl_Position = vec4(position.xy, 1.0, 1.0);
      }
    `,
    fragmentShader: /* glsl */ `
      uniform vec3 top;
      uniform vec3 haze;
      uniform vec3 bottom;
      uniform float horizon;
      uniform float vignette;
      varying vec2 vAt;
      void main() {
        float above = vAt.y - horizon;
        vec3 color = above > 0.0
          ? mix(top, haze, exp(-above * above / 0.5))
          : mix(bottom, haze, exp(-above * above / 0.9));
        color *= 1.0 - vignette * smoothstep(0.55, 1.6, length(vAt * vec2(0.85, 1.0)));
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
    depthTest: false,
    depthWrite: false,
    // In the opaque list, which is drawn first, yet blended.
    transparent: false,
    blending: CustomBlending,
    blendSrc: SrcAlphaFactor,
    blendDst: OneMinusSrcAlphaFactor,
    blendSrcAlpha: OneFactor,
    blendDstAlpha: OneMinusSrcAlphaFactor,
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
          return (0.5 * wide + 0.85 * contact + 0.16 * narrow) * (1.0 - smoothstep(0.9, 1.0, edge));
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

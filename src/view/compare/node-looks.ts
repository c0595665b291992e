/**
 * Balls and bones that tell by their looks how joints compare: plain, red, striped, or translucent for the other
 * program's. Drawn from a `NodeBuffer`, after everything else and in front of it: `inFront` clears the depth first.
 *
 *     look    NO_LOOK  not drawn
 *             AGREES   grey
 *             OWN      red
 *             INHERITED  light and dark stripes, on the screen, so that they are seen on the thinnest bone
 *             THEIRS   the colour of the other program's
 *             + LIT    under the pointer
 */
import {
  type BufferGeometry,
  Color,
  CylinderGeometry,
  Group,
  InstancedBufferAttribute,
  ShaderMaterial,
  SphereGeometry,
  type WebGLRenderer,
} from 'three';
import { rawColor } from '../scene/thick-lines.ts';
import { drawnByNodes, NodeBuffer, NodeMesh, type NodeShape } from '../skeleton/node-buffer.ts';
import type { StageTheme } from '../theme.ts';
import { compareColours } from './compare-colours.ts';

export const NO_LOOK = 0;
export const AGREES = 1;
export const OWN = 2;
export const INHERITED = 3;
export const THEIRS = 4;
export const LIT = 8;

/** CSS pixels from stripe to stripe. */
const STRIPE_PIXELS = 7;

export class NodeLooks {
  readonly object = new Group();
  /** Positions and radii: see `NodeBuffer`. */
  readonly nodes = new NodeBuffer();
  private readonly ball = new SphereGeometry(1, 16, 10);
  private readonly bone = new CylinderGeometry(0.45, 1, 1, 12, 1, true).translate(0, 0.5, 0);
  private readonly uniforms = {
    agrees: { value: new Color() },
    own: { value: new Color() },
    inherited: { value: new Color() },
    stripe: { value: new Color() },
    theirs: { value: new Color() },
    lit: { value: new Color() },
    opacity: { value: 1 },
    period: { value: STRIPE_PIXELS },
  };
  private readonly balls: Drawn;
  private readonly bones: Drawn;

  /**
   * @param order of drawing; the bones are drawn first, the balls with the next number
   * @param opacity below 1: overlapping nodes don't blend with each other
   */
  constructor(order: number, opacity: number) {
    this.uniforms.opacity.value = opacity;
    this.bones = new Drawn(this.bone, 'bone', this.uniforms);
    this.balls = new Drawn(this.ball, 'ball', this.uniforms);
    this.bones.order = order;
    this.balls.order = order + 1;
    this.object.add(this.bones.group, this.balls.group);
    this.bones.beforeDraw = (renderer) => {
      this.uniforms.period.value = STRIPE_PIXELS * renderer.getPixelRatio();
      renderer.clearDepth();
    };
  }

  setTheme(theme: StageTheme): void {
    const { uniforms } = this;
    const colours = compareColours(theme);
    for (const name of ['agrees', 'own', 'inherited', 'stripe'] as const) {
      uniforms[name].value.copy(rawColor(colours[name]));
    }
    uniforms.theirs.value.copy(rawColor(theme.comparedFirst));
    uniforms.lit.value.copy(rawColor(theme.hovered));
  }

  /** Makes room for `count` nodes, and gives them their looks: of the ball, and of the bone to it. */
  setLooks(ofBalls: Uint8Array, ofBones: Uint8Array): void {
    this.nodes.resize(ofBalls.length, [this.ball, this.bone]);
    this.balls.setLooks(ofBalls);
    this.bones.setLooks(ofBones);
  }

  dispose(): void {
    this.balls.dispose();
    this.bones.dispose();
    this.ball.dispose();
    this.bone.dispose();
  }
}

/** One shape for all nodes. */
class Drawn {
  readonly group = new Group();
  order = 0;
  beforeDraw: (renderer: WebGLRenderer) => void = () => {};
  private readonly material: ShaderMaterial;
  private mesh: NodeMesh | undefined;
  private looks: InstancedBufferAttribute | undefined;

  constructor(
    private readonly geometry: BufferGeometry,
    private readonly shape: NodeShape,
    uniforms: ShaderMaterial['uniforms'],
  ) {
    this.material = drawnByNodes(lookMaterial(uniforms), shape);
  }

  setLooks(looks: Uint8Array): void {
    let own = this.looks;
    if (!own || own.count < looks.length) {
      own = new InstancedBufferAttribute(new Float32Array(looks.length), 1);
      this.looks = own;
      this.geometry.setAttribute('look', own);
      this.mesh?.removeFromParent();
      this.mesh?.dispose();
      const mesh = new NodeMesh(this.geometry, this.material, looks.length, this.shape);
      mesh.frustumCulled = false;
      mesh.matrixAutoUpdate = false;
      mesh.renderOrder = this.order;
      mesh.onBeforeRender = (renderer) => this.beforeDraw(renderer);
      this.group.add(mesh);
      this.mesh = mesh;
    }
    own.set(looks);
    own.needsUpdate = true;
    if (this.mesh) this.mesh.count = looks.length;
  }

  dispose(): void {
    this.mesh?.dispose();
    this.material.dispose();
  }
}

function lookMaterial(uniforms: ShaderMaterial['uniforms']): ShaderMaterial {
  return new ShaderMaterial({
    // Among what is drawn last.
    transparent: true,
    toneMapped: false,
    uniforms,
    vertexShader: /* glsl */ `
      attribute float look;
      flat varying float vLook;
      varying vec3 vNormal;
      void main() {
        vLook = look;
        // Equal radii on both axes across a bone keep its normals' directions without an inverse.
        vNormal = mat3(modelViewMatrix) * (mat3(instanceMatrix) * normal);
        gl_Position = projectionMatrix * (modelViewMatrix * (instanceMatrix * vec4(position, 1.0)));
        if (look < 0.5) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
      }
    `,
    fragmentShader: /* glsl */ `
      uniform vec3 agrees;
      uniform vec3 own;
      uniform vec3 inherited;
      uniform vec3 stripe;
      uniform vec3 theirs;
      uniform vec3 lit;
      uniform float opacity;
      uniform float period;
      flat varying float vLook;
      varying vec3 vNormal;
      void main() {
        vec3 color = agrees;
        bool isLit = vLook > 7.5;
        float look = isLit ? vLook - 8.0 : vLook;
        if (look > 3.5) color = theirs;
        else if (look > 2.5) color = fract((gl_FragCoord.x + gl_FragCoord.y) * 0.70711 / period) < 0.5 ? inherited : stripe;
        else if (look > 1.5) color = own;
        if (isLit) color = mix(color, lit, 0.6);
        float facing = abs(normalize(vNormal).z);
        gl_FragColor = vec4(color * mix(0.62, 1.0, facing), opacity);
      }
    `,
  });
}

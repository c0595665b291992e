/**
 * Numbers and axis letters in the scene at a fixed size on screen: one instanced quad per glyph from a glyph atlas, one
 * draw call for all. They are part of the scene, drawn before characters and screenshots contain them. (HTML labels
 * would float over everything.)
 *
 *     instance: position (x y z), offset of the glyph in CSS pixels (x y), glyph index, axis that it fades along,
 *     colour r g b a
 */
import {
  AddEquation,
  BufferAttribute,
  CanvasTexture,
  type Color,
  CustomBlending,
  DynamicDrawUsage,
  InstancedBufferAttribute,
  InstancedBufferGeometry,
  LinearFilter,
  Mesh,
  NoColorSpace,
  OneFactor,
  OneMinusSrcAlphaFactor,
  ShaderMaterial,
  SrcAlphaFactor,
  Vector2,
  Vector3,
} from 'three';
import { LINE_RESOLUTION, rawColor } from './thick-lines.ts';

const GLYPHS = '0123456789.−+exyz';
/** CSS pixels of a glyph's cell, halo included. */
const CELL_WIDTH = 12;
const CELL_HEIGHT = 18;
const FONT_PX = 11;

export class Glyphs {
  readonly object: Mesh<InstancedBufferGeometry, ShaderMaterial>;
  private readonly place: InstancedBufferAttribute;
  private readonly offset: InstancedBufferAttribute;
  private readonly color: InstancedBufferAttribute;
  private readonly advances = new Float32Array(GLYPHS.length);
  private pixelRatio = 0;
  private count = 0;

  constructor(private readonly capacity: number) {
    const geometry = new InstancedBufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0]), 3));
    geometry.setIndex([0, 1, 2, 2, 1, 3]);
    const add = (name: string, size: number) => {
      const attribute = new InstancedBufferAttribute(new Float32Array(size * capacity), size).setUsage(
        DynamicDrawUsage,
      );
      geometry.setAttribute(name, attribute);
      return attribute;
    };
    this.place = add('place', 3);
    this.offset = add('offset', 4);
    this.color = add('tint', 4);
    this.object = new Mesh(geometry, glyphMaterial());
    this.object.frustumCulled = false;
    this.object.matrixAutoUpdate = false;
  }

  /** Renders the atlas for a device pixel ratio. */
  setPixelRatio(ratio: number): void {
    if (ratio === this.pixelRatio) return;
    this.pixelRatio = ratio;
    const canvas = document.createElement('canvas');
    canvas.width = Math.ceil(CELL_WIDTH * ratio) * GLYPHS.length;
    canvas.height = Math.ceil(CELL_HEIGHT * ratio);
    const pen = canvas.getContext('2d', { willReadFrequently: false });
    if (!pen) return;
    pen.font = `500 ${FONT_PX * ratio}px system-ui, -apple-system, "Segoe UI", sans-serif`;
    pen.textBaseline = 'middle';
    pen.lineJoin = 'round';
    const cell = Math.ceil(CELL_WIDTH * ratio);
    let digit = 0;
    for (const c of '0123456789') digit = Math.max(digit, pen.measureText(c).width);
    for (let g = 0; g < GLYPHS.length; g++) {
      const own = pen.measureText(GLYPHS[g]).width;
      // All digits are as wide as the widest, so that columns line up in any font.
      const width = GLYPHS[g] >= '0' && GLYPHS[g] <= '9' ? digit : own;
      this.advances[g] = width / ratio;
      const x = g * cell + 2 * ratio + (width - own) / 2;
      // Red is the letter, green the letter with its halo.
      pen.globalCompositeOperation = 'lighter';
      pen.lineWidth = 3.5 * ratio;
      pen.strokeStyle = pen.fillStyle = '#00ff00';
      pen.strokeText(GLYPHS[g], x, canvas.height / 2);
      pen.fillStyle = '#ff0000';
      pen.fillText(GLYPHS[g], x, canvas.height / 2);
    }
    const texture = new CanvasTexture(canvas);
    texture.colorSpace = NoColorSpace;
    texture.minFilter = texture.magFilter = LinearFilter;
    texture.generateMipmaps = false;
    const { uniforms } = this.object.material;
    uniforms.glyphs.value?.dispose();
    uniforms.glyphs.value = texture;
    uniforms.pixelRatio.value = ratio;
    uniforms.cell.value.set(cell / ratio, canvas.height / ratio);
  }

  setHalo(css: string): void {
    this.object.material.uniforms.halo.value.copy(rawColor(css));
  }

  /** Where those that fade are opaque, and how far from there they are gone; along their axis. */
  fadeAround(centre: Vector3, reach: number): void {
    const { uniforms } = this.object.material;
    uniforms.fadeCentre.value.copy(centre);
    uniforms.fadeReach.value = reach;
  }

  begin(): void {
    this.count = 0;
  }

  /**
   * Writes `text` with its left middle `dx` right of and `dy` above a point (CSS pixels). Unknown characters are
   * skipped.
   *
   * @param at x y z
   * @param fades the axis (0 to 2) along which it fades; -1: it doesn't
   */
  add(text: string, at: ArrayLike<number>, dx: number, dy: number, color: Color, opacity: number, fades: number): void {
    let x = dx;
    for (let c = 0; c < text.length && this.count < this.capacity; c++) {
      const glyph = GLYPHS.indexOf(text[c]);
      if (glyph < 0) continue;
      this.place.setXYZ(this.count, at[0], at[1], at[2]);
      this.offset.setXYZW(this.count, x, dy, glyph, fades);
      this.color.setXYZW(this.count, color.r, color.g, color.b, opacity);
      x += this.advances[glyph];
      this.count++;
    }
  }

  end(): void {
    this.object.geometry.instanceCount = this.count;
    this.object.visible = this.count > 0;
    for (const attribute of [this.place, this.offset, this.color]) attribute.needsUpdate = true;
  }

  dispose(): void {
    this.object.material.uniforms.glyphs.value?.dispose();
    this.object.material.dispose();
    this.object.geometry.dispose();
  }
}

function glyphMaterial(): ShaderMaterial {
  return new ShaderMaterial({
    depthTest: false,
    // Custom, so that it blends in the opaque list, which is drawn first.
    blending: CustomBlending,
    blendEquation: AddEquation,
    blendSrc: SrcAlphaFactor,
    blendDst: OneMinusSrcAlphaFactor,
    blendSrcAlpha: OneFactor,
    blendDstAlpha: OneMinusSrcAlphaFactor,
    depthWrite: false,
    toneMapped: false,
    uniforms: {
      resolution: LINE_RESOLUTION,
      pixelRatio: { value: 1 },
      cell: { value: new Vector2(CELL_WIDTH, CELL_HEIGHT) },
      glyphs: { value: null },
      halo: { value: rawColor('#000000') },
      fadeCentre: { value: new Vector3() },
      fadeReach: { value: 1 },
    },
    vertexShader: /* glsl */ `
      attribute vec3 place;
      attribute vec4 offset;
      attribute vec4 tint;
      uniform vec2 resolution;
      uniform vec2 cell;
      uniform float pixelRatio;
      uniform vec3 fadeCentre;
      uniform float fadeReach;
      varying vec2 vUv;
      varying vec4 vTint;
      void main() {
        vec4 p = projectionMatrix * (modelViewMatrix * vec4(place, 1.0));
        // Aligned to device pixels, to stay sharp.
        vec2 pixels = resolution * pixelRatio;
        vec2 corner = (p.xy / p.w * 0.5 + 0.5) * pixels + (offset.xy - vec2(2.0, 0.5 * cell.y)) * pixelRatio;
        corner = floor(corner + 0.5) + position.xy * cell * pixelRatio;
        p.xy = (corner / pixels * 2.0 - 1.0) * p.w;
        gl_Position = p;
        vUv = vec2((offset.z + position.x) / ${GLYPHS.length}.0, position.y);
        vTint = tint;
        if (offset.w < 0.0) return;
        int axis = int(offset.w);
        float away = (place[axis] - fadeCentre[axis]) / fadeReach;
        vTint.a *= max(1.0 - away * away, 0.0);
      }
    `,
    fragmentShader: /* glsl */ `
      uniform sampler2D glyphs;
      uniform vec3 halo;
      varying vec2 vUv;
      varying vec4 vTint;
      void main() {
        vec2 ink = texture2D(glyphs, vUv).rg;
        float around = 0.25 * ink.g;
        float alpha = max(ink.r, around);
        if (alpha < 0.01) discard;
        gl_FragColor = vec4(mix(halo, vTint.rgb, ink.r / alpha * ink.r), alpha * vTint.a);
      }
    `,
  });
}

/** The walker's colours: fur, coat, boots, each a function from a point in the binding pose to a colour. */
import { smoothstep } from '../../../src/math/smoothstep.ts';
import type { Vec3 } from '../../../src/math/vec3.ts';
import { Atlas, blend, type Colour, colour } from '../paint/atlas.ts';
import { SHAPES } from './body.ts';
import { ATLAS_SIZE, type PartName, RECTS } from './body-parts.ts';
import { squareToDisc } from './head.ts';

const FUR = colour('#dd7b3c');
const FUR_DARK = colour('#b9552a');
const CREAM = colour('#fdeed4');
const COCOA = colour('#6b443b');
const BLUSH = colour('#f29a84');
const TEAL = colour('#2f938c');
const TEAL_DARK = colour('#1f6b6e');
const MUSTARD = colour('#f4b840');
const NAVY = colour('#3a4a6b');
const LEATHER = colour('#96603a');
const LEATHER_DARK = colour('#6d4229');
const CORAL = colour('#e2614f');
const RUBBER = colour('#efe3cc');
const NIGHT = colour('#2a1a1c');

/** `p`: the point in bind space (x ≥ 0, the texture's half); `v` along the part; `fold` 0 front … 1 back. */
type Painter = (p: Vec3, v: number, fold: number) => Colour;

const inEllipse = (x: number, y: number, cx: number, cy: number, rx: number, ry: number) =>
  Math.hypot((x - cx) / rx, (y - cy) / ry);

const head: Painter = (p) => {
  const x = Math.abs(p[0]);
  const [, y, z] = p;
  let c = blend(FUR, FUR_DARK, 0.55 * smoothstep(1.5, 1.2, y) + 0.25 * smoothstep(0.1, -0.35, z));
  // A dark stripe over the crown, from the brows to the neck.
  c = blend(c, FUR_DARK, 0.75 * smoothstep(0.075, 0.06, x) * smoothstep(1.74, 1.8, y + 0.5 * Math.max(0, -z)));
  // Cheeks, in angles about the head, ending in three points of fur toward the back.
  const turn = Math.atan2(x, z - 0.02);
  const ragged = turn > 1.35 ? 0.16 * Math.abs((((y - 1.32) * 13) % 1) - 0.5) : 0;
  if (inEllipse(turn + ragged, y, 1.24, 1.43, 0.52, 0.112) < 1) c = CREAM;
  if (z < -0.02) return c;
  const front = smoothstep(-0.02, 0.05, z);
  // Brows, the tear stripes between cheeks and muzzle, the muzzle.
  if (inEllipse(x, y, 0.17, 1.725, 0.062, 0.04) < 1) c = CREAM;
  const stripe = Math.abs(x - 0.175 - 0.28 * (1.54 - y));
  if (stripe < 0.036 && y < 1.54 && y > 1.3) c = FUR_DARK;
  const muzzle = inEllipse(x, y, 0, 1.39, 0.165, 0.125);
  const bridge = inEllipse(x, y, 0, 1.48, 0.085, 0.1);
  if (Math.min(muzzle, bridge) < 1) c = CREAM;
  const blush = Math.hypot((x - 0.31) / 0.075, (y - 1.455) / 0.05);
  return blend(c, BLUSH, 0.75 * smoothstep(1, 0.35, blush) * front);
};

const torso: Painter = (p) => {
  const x = Math.abs(p[0]);
  const [, y, z] = p;
  let c = blend(TEAL, TEAL_DARK, 0.5 * smoothstep(0.75, 0.58, y) + 0.35 * smoothstep(0.98, 1.08, y));
  const isFront = z > 0;
  if (y > 1.1) return MUSTARD; // under the scarf
  if (y < 0.6) c = MUSTARD; // trimmed hem
  if (y < 0.553) c = TEAL_DARK; // its inside
  if (Math.abs(y - 0.607) < 0.004) c = TEAL_DARK;
  // The coat's opening with toggles, pockets, and the straps of the pack.
  if (isFront && y > 0.6) {
    if (x < 0.006) c = TEAL_DARK;
    for (const toggle of [0.7, 0.79, 0.88]) if (inEllipse(x, y, 0, toggle, 0.024, 0.014) < 1) c = CREAM;
    const inPocket = Math.abs(x - 0.115) < 0.05 && y > 0.63 && y < 0.715;
    if (inPocket) c = y > 0.695 ? MUSTARD : blend(TEAL, TEAL_DARK, 0.75);
    if (Math.abs(x - 0.125 - 0.25 * Math.max(0, 0.95 - y)) < 0.021 && y > 0.8) c = LEATHER;
  }
  if (!isFront && Math.abs(x - 0.125) < 0.022 && y > 0.75) c = LEATHER;
  return c;
};

const arm: Painter = (_p, v) => {
  const s = v * 12;
  if (s > 7.6) return blend(COCOA, NIGHT, 0.4 * smoothstep(9, 12, s));
  if (s > 6.1) return MUSTARD;
  if (s > 5.95) return TEAL_DARK;
  return blend(TEAL, TEAL_DARK, 0.45 * smoothstep(3, 0.8, s));
};

const leg: Painter = (p, _v, fold) => {
  const y = p[1];
  if (y < 0.258) return y > 0.235 ? MUSTARD : blend(LEATHER, LEATHER_DARK, 0.5 * smoothstep(0.17, 0.1, y));
  if (y < 0.283) return blend(NAVY, CREAM, 0.25);
  // A patch on the knee.
  const knee = inEllipse(fold * Math.PI * 0.1, y, 0, 0.385, 0.05, 0.036);
  if (knee < 1) return knee > 0.78 && knee < 0.9 ? CREAM : CORAL;
  return blend(NAVY, NIGHT, 0.35 * smoothstep(0.46, 0.58, y));
};

const foot: Painter = (p, _v, fold) => {
  const z = p[2];
  if (fold > 0.81) return blend(LEATHER_DARK, NIGHT, 0.3);
  if (fold > 0.63) return fold < 0.655 ? LEATHER_DARK : RUBBER;
  if (z > 0.135) return LEATHER_DARK;
  if (fold < 0.17 && z > 0.02 && z < 0.125) return Math.abs(((z * 38) % 1) - 0.5) < 0.2 ? CREAM : LEATHER_DARK;
  return LEATHER;
};

const tail: Painter = (_p, v) => {
  const s = v * 11;
  if (s > 9.1) return COCOA;
  const ring = (s - 1.6) / 1.5;
  return s > 1.6 && ring - Math.floor(ring) < 0.42 ? blend(FUR_DARK, COCOA, 0.25) : FUR;
};

const scarf: Painter = (_p, v, fold) => {
  const band = (v * 7 + fold * 2) % 1.75;
  return band < 0.4 ? CREAM : blend(MUSTARD, FUR, 0.5 * Math.abs(v - 0.5) * 2 * 0.7);
};

const scarfTail: Painter = (p, v) => {
  if (v > 0.93) return CREAM;
  if (Math.abs(p[1] - 0.86) < 0.013 || Math.abs(p[1] - 0.825) < 0.013) return CREAM;
  return blend(MUSTARD, FUR, 0.35 * smoothstep(0.35, 0, v));
};

const pack: Painter = (p, _v, fold) => {
  const x = Math.abs(p[0]);
  const y = p[1];
  const isBack = fold > 0.5;
  // Flap, its edge, two buckled straps, a pocket.
  const flap = 0.925 + 0.09 * (x / 0.18) ** 2;
  if (isBack && x > 0.075 && x < 0.108) return Math.abs(y - 0.885) < 0.017 ? MUSTARD : LEATHER_DARK;
  if (isBack && Math.abs(y - flap) < 0.008) return LEATHER_DARK;
  if (y > flap) return blend(LEATHER, CORAL, 0.12);
  if (isBack && x < 0.06 && Math.abs(y - 0.83) < 0.04) return blend(LEATHER, MUSTARD, 0.4);
  return blend(LEATHER, LEATHER_DARK, 0.25 + 0.4 * smoothstep(0.85, 0.77, y));
};

const bedroll: Painter = (p, v) => {
  const x = Math.abs(p[0]);
  if (v < 0.2 || v > 0.8) {
    const r = Math.hypot(p[1] - 1.115, p[2] + 0.285);
    return (r * 55) % 1 < 0.4 ? CREAM : CORAL;
  }
  if (Math.abs(x - 0.09) < 0.016) return LEATHER_DARK;
  return Math.abs(x - 0.17) < 0.012 ? CREAM : CORAL;
};

const ear: Painter = (_p, v, fold) => {
  const inner = Math.hypot(fold / 0.36, (v - 0.36) / 0.4);
  if (inner < 1) return blend(COCOA, FUR_DARK, 0.35 * smoothstep(0.5, 1, inner));
  if (fold < 0.53) return CREAM;
  return blend(FUR, FUR_DARK, 0.4);
};

const tuft: Painter = (_p, v) => blend(FUR_DARK, FUR, v);
const thumb: Painter = () => COCOA;

/** Flat things are painted in their own square, −1 … 1. */
type FlatPainter = (x: number, y: number) => Colour;

const eye: FlatPainter = (s, t) => {
  const [x, y] = squareToDisc(s, t);
  if (Math.hypot((x + 0.3) / 0.27, (y - 0.42) / 0.25) < 1) return [255, 255, 255];
  if (Math.hypot((x - 0.34) / 0.13, (y + 0.02) / 0.11) < 1) return [255, 255, 255];
  const glow = Math.hypot(x / 0.75, (y + 0.62) / 0.42);
  const inside = blend(NIGHT, colour('#8a4a2a'), 0.85 * smoothstep(1, 0.2, glow));
  return blend(inside, NIGHT, smoothstep(0.72, 0.86, Math.hypot(x, y)));
};

const nose: FlatPainter = (s, t) => {
  const [x, y] = squareToDisc(s, t);
  return blend(NIGHT, colour('#b08a86'), 0.9 * smoothstep(1, 0.5, Math.hypot((x + 0.15) / 0.4, (y - 0.42) / 0.22)));
};

const mouth: FlatPainter = (x, y) => {
  if (y > 0.72) return NIGHT;
  return blend(colour('#7c2530'), colour('#f0807a'), smoothstep(0.95, 0.7, Math.hypot(x / 0.75, (y + 1) / 0.95)));
};

const painters: Record<Exclude<PartName, 'eye' | 'nose' | 'mouth'>, Painter> = {
  head,
  torso,
  arm,
  leg,
  foot,
  tail,
  scarf,
  scarfTail,
  pack,
  bedroll,
  ear,
  tuft,
  thumb,
};

export function paintWalker(): Atlas {
  const atlas = new Atlas(ATLAS_SIZE, TEAL_DARK);
  const done = new Set<PartName>();
  for (const shape of SHAPES) {
    if (done.has(shape.name) || shape.name === 'eye' || shape.name === 'nose' || shape.name === 'mouth') continue;
    done.add(shape.name);
    const painter = painters[shape.name];
    atlas.paint(RECTS[shape.name], (u, v) => painter(shape.point(u * Math.PI, v), v, u));
  }
  atlas.paint(RECTS.eye, (u, v) => eye(2 * u - 1, 2 * v - 1));
  atlas.paint(RECTS.nose, (u, v) => nose(2 * u - 1, 2 * v - 1));
  atlas.paint(RECTS.mouth, (u, v) => mouth(2 * u - 1, 2 * v - 1));
  return atlas;
}

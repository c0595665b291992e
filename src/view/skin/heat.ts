/**
 * Colours of the joint weight heat map, from deep blue through violet and coral to pale yellow. Lightness is linear in
 * OKLab, so that equal steps of weight look equal, in greyscale and to colour-blind eyes too. (Rainbow maps such as jet
 * or turbo have bright bands that look like edges.)
 *
 * OKLab: B. Ottosson, "A perceptual color space for image processing", 2020.
 */
import { DataTexture, LinearFilter, NearestFilter, RGBAFormat, SRGBColorSpace, UnsignedByteType } from 'three';

/** Evenly spaced stops: OKLab lightness, chroma, and hue in degrees. */
const STOPS: readonly (readonly [lightness: number, chroma: number, hue: number])[] = [
  [0.3, 0.09, 268],
  [0.43, 0.15, 292],
  [0.56, 0.17, 342],
  [0.69, 0.15, 25],
  [0.81, 0.13, 68],
  [0.94, 0.09, 100],
];

/** Colour of a weight from 0 to 1, as sRGB bytes; clamped outside. */
export function heatColour(influence: number): [number, number, number] {
  const at = Math.min(1, Math.max(0, influence)) * (STOPS.length - 1);
  const i = Math.min(STOPS.length - 2, Math.floor(at));
  const [l0, c0, h0] = STOPS[i];
  const [l1, c1, h1] = STOPS[i + 1];
  const t = at - i;
  const turn = ((h1 - h0 + 540) % 360) - 180;
  return toSrgb(l0 + (l1 - l0) * t, c0 + (c1 - c0) * t, ((h0 + turn * t) * Math.PI) / 180);
}

function toSrgb(lightness: number, chroma: number, hue: number): [number, number, number] {
  const a = chroma * Math.cos(hue);
  const b = chroma * Math.sin(hue);
  const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
  return [
    encode(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
    encode(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
    encode(-0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s),
  ];
}

/** Linear light to an sRGB byte. */
function encode(x: number): number {
  const y = x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055;
  return Math.round(255 * Math.min(1, Math.max(0, y)));
}

const WIDTH = 256;
let ramp: DataTexture | undefined;

/** The ramp as a shared texture, 0 at the left. */
export function heatRamp(): DataTexture {
  if (ramp) return ramp;
  const bytes = new Uint8Array(4 * WIDTH);
  for (let x = 0; x < WIDTH; x++) bytes.set([...heatColour(x / (WIDTH - 1)), 255], 4 * x);
  ramp = new DataTexture(bytes, WIDTH, 1, RGBAFormat, UnsignedByteType);
  ramp.colorSpace = SRGBColorSpace;
  ramp.magFilter = LinearFilter;
  ramp.minFilter = NearestFilter;
  ramp.needsUpdate = true;
  return ramp;
}

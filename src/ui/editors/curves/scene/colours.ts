/**
 * Colours of the curves. What goes by an axis (`model/dof-axis.ts`) has its red, green or blue; what else there is (morph weights) has mixtures of these and the accent. Several joints
 * at once are told apart by a part of the text's colour mixed in, and past that by dashes: mixing towards the text only ever makes a line easier to see, and nothing
 * comes near the orange of what is selected, as turning the hue would. Only what follows another DOF is fainter: its keys
 * count for nothing.
 *
 * A colour is a recipe until it is drawn, so that the theme can change under it: `color-mix(in oklab, …)` in CSS, the
 * same arithmetic here for canvases, which can't read custom properties.
 */
import type { AxisLetter } from '../../../../model/dof-axis.ts';
import { perPair } from '../../../../model/per-object.ts';

/** Colours that can be mixed, and the custom properties that hold them. */
export const BASE_COLOURS = {
  x: '--axis-x',
  y: '--axis-y',
  z: '--axis-z',
  accent: '--accent',
  text: '--text',
  faint: '--text-faint',
} as const;
export type BaseColour = keyof typeof BASE_COLOURS;

export interface LineColour {
  readonly base: BaseColour;
  /** Mixed in, by that `part` (0 … 1). */
  readonly with: BaseColour;
  readonly part: number;
  /** Pixels drawn and left out, alternating; empty for an unbroken line. */
  readonly dash: readonly number[];
}

const UNBROKEN: readonly number[] = [];
const DASHED: readonly number[] = [10, 3];
const FOLLOWS: readonly number[] = [1, 4];
/** How much of the text's colour is in the lines of the first, second and third joint. */
const TINTS = [0, 0.34, 0.64];

const MORPHS: readonly (readonly [BaseColour, BaseColour, number])[] = [
  ['accent', 'text', 0],
  ['y', 'z', 0.5],
  ['x', 'z', 0.4],
  ['y', 'x', 0.4],
];

/** @param ordinal which of the joints shown together it is, from 0 */
export function axisColour(axis: AxisLetter, ordinal: number): LineColour {
  return {
    base: axis,
    with: 'text',
    part: TINTS[ordinal % TINTS.length],
    dash: Math.floor(ordinal / TINTS.length) % 2 ? DASHED : UNBROKEN,
  };
}

/** For a DOF that follows another one. */
export function followingColour({ base }: LineColour): LineColour {
  return { base, with: 'faint', part: 0.7, dash: FOLLOWS };
}

/** @param ordinal which of the channels without an axis it is, from 0 */
export function otherColour(ordinal: number): LineColour {
  const [base, mixedIn, part] = MORPHS[ordinal % MORPHS.length];
  return { base, with: mixedIn, part, dash: Math.floor(ordinal / MORPHS.length) % 2 ? DASHED : UNBROKEN };
}

/** For a stylesheet or a `style` attribute. */
export function cssColour({ base, with: other, part }: LineColour): string {
  const own = `var(${BASE_COLOURS[base]})`;
  return part === 0 ? own : `color-mix(in oklab, ${own}, var(${BASE_COLOURS[other]}) ${Math.round(100 * part)}%)`;
}

/** `#rrggbb`, mixed as CSS does. @param palette each base colour as `#rrggbb` */
export function mixed(colour: LineColour, palette: Readonly<Record<BaseColour, string>>): string {
  const own = palette[colour.base];
  return colour.part === 0 ? own : mixture(palette, colour);
}

/** Kept: a hundred lines ask at every frame. */
const mixture = perPair((palette: Readonly<Record<BaseColour, string>>, { base, with: other, part }: LineColour) =>
  mixOklab(palette[base], palette[other], part),
);

type Triple = readonly [number, number, number];

/** Between two colours of the form `#rrggbb` in Björn Ottosson's Oklab, where half way looks like half way. */
export function mixOklab(from: string, to: string, part: number): string {
  const a = toOklab(from);
  const b = toOklab(to);
  return fromOklab([a[0] + (b[0] - a[0]) * part, a[1] + (b[1] - a[1]) * part, a[2] + (b[2] - a[2]) * part]);
}

/** https://bottosson.github.io/posts/oklab/ */
function toOklab(hex: string): Triple {
  const [r, g, b] = [1, 3, 5].map((at) => {
    const c = Number.parseInt(hex.slice(at, at + 2), 16) / 255;
    return c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
  });
  const l = Math.cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const m = Math.cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const s = Math.cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return [
    0.2104542553 * l + 0.793617785 * m - 0.0040720468 * s,
    1.9779984951 * l - 2.428592205 * m + 0.4505937099 * s,
    0.0259040371 * l + 0.7827717662 * m - 0.808675766 * s,
  ];
}

function fromOklab([lightness, a, b]: Triple): string {
  const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
  const linear = [
    4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
    -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
    -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s,
  ];
  return `#${linear.map(channelText).join('')}`;
}

function channelText(linear: number): string {
  const c = linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055;
  return Math.round(255 * Math.min(1, Math.max(0, c)))
    .toString(16)
    .padStart(2, '0');
}

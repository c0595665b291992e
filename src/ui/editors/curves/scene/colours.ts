/**
 * Colours of the curves. Channels with an axis (`model/dof-axis.ts`) have its colour, one for turning and another for
 * moving along it; others (morph weights) have mixtures of these and the accent. Several joints at once are
 * distinguished by mixing in some of the text's colour, and further ones by dashes: mixing towards the text never
 * reduces contrast, and unlike turning the hue it never comes near the orange of the selection. Only linked DOFs are
 * fainter, as their keys have no effect.
 *
 * A colour is a recipe until it is drawn, so that the theme can change under it: `color-mix(in oklab, …)` in CSS, the
 * same arithmetic here for canvases, which can't read custom properties.
 */

import { mixOklab } from '../../../../math/oklab.ts';
import { perPair } from '../../../../model/per-object.ts';
import type { AxisLetter } from '../../../../model/skeleton/dof-axis.ts';

/** Colours that can be mixed, and their custom properties. */
export const BASE_COLOURS = {
  x: '--axis-x',
  y: '--axis-y',
  z: '--axis-z',
  moveX: '--move-x',
  moveY: '--move-y',
  moveZ: '--move-z',
  accent: '--accent',
  text: '--text',
  faint: '--text-faint',
} as const;
export type BaseColour = keyof typeof BASE_COLOURS;

export interface LineColour {
  readonly base: BaseColour;
  /** Mixed in, with weight `part` (0 … 1). */
  readonly with: BaseColour;
  readonly part: number;
  /** Lengths in pixels of dashes and gaps, alternating; empty for a solid line. */
  readonly dash: readonly number[];
}

const UNBROKEN: readonly number[] = [];
const DASHED: readonly number[] = [10, 3];
const FOLLOWS: readonly number[] = [1, 4];
/** Part of the text's colour in the lines of the first, second and third joint. */
const TINTS = [0, 0.34, 0.64];

const MORPHS: readonly (readonly [BaseColour, BaseColour, number])[] = [
  ['accent', 'text', 0],
  ['y', 'z', 0.5],
  ['x', 'z', 0.4],
  ['y', 'x', 0.4],
];

const MOVES: Readonly<Record<AxisLetter, BaseColour>> = { x: 'moveX', y: 'moveY', z: 'moveZ' };

/** @param ordinal index of the joint among those shown together */
export function axisColour(axis: AxisLetter, ordinal: number, moves = false): LineColour {
  return {
    base: moves ? MOVES[axis] : axis,
    with: 'text',
    part: TINTS[ordinal % TINTS.length],
    dash: Math.floor(ordinal / TINTS.length) % 2 ? DASHED : UNBROKEN,
  };
}

/** For a linked DOF. */
export function followingColour({ base }: LineColour): LineColour {
  return { base, with: 'faint', part: 0.7, dash: FOLLOWS };
}

/** @param ordinal index of the channel among those without an axis */
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

/** How much of the background is in a faint line. */
const FAINTNESS = 0.6;

/** The colour of a faint line, nearly that of the plot behind it. @param ground `#rrggbb` */
export function faintly(colour: LineColour, palette: Readonly<Record<BaseColour, string>>, ground: string): string {
  const own = mixed(colour, palette);
  const key = own + ground;
  const faint = known.get(key) ?? mixOklab(own, ground, FAINTNESS);
  known.set(key, faint);
  return faint;
}
/** Thousands of lines ask every frame, for a few colours in two themes. */
const known = new Map<string, string>();

/** Cached: a hundred lines ask every frame. */
const mixture = perPair((palette: Readonly<Record<BaseColour, string>>, { base, with: other, part }: LineColour) =>
  mixOklab(palette[base], palette[other], part),
);

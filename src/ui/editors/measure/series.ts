/** What the plot shows: whose motion, which quantity, and each as a row of values with its name. */
import { type Frames, MAX_FRAMES } from '../../../evaluate/bake.ts';
import { type Quantity, quantityOf } from '../../../evaluate/measure/quantities.ts';
import { measuredFrames, type Tracks } from '../../../evaluate/measure/tracks.ts';
import type { Character } from '../../../model/document.ts';
import { jointName } from '../../../model/skeleton/joint-name.ts';
import { jointsIn } from '../../../model/skeleton/selected-joints.ts';
import { harmless, quoted } from '../../../review/formula-cells.ts';
import { comparedIn, drawnDocument, playedName } from '../../state/takes.ts';
import type { Uses } from '../../state/workbench.ts';
import { count, exact } from '../../widgets/numbers/number-text.ts';

export const SUBJECTS = ['joints', 'feet', 'mass'] as const;
export type Subject = (typeof SUBJECTS)[number];

/** More characters can't be told apart. */
export const MAX_OVERLAID = 8;

export interface QuantityLabel {
  readonly label: string;
  /** After that of lengths, if it is one: `m/s`. */
  readonly unit: string;
  readonly isLength: boolean;
}

export const QUANTITY_LABELS: Readonly<Record<Quantity, QuantityLabel>> = {
  x: { label: 'Position x', unit: '', isLength: true },
  height: { label: 'Height (y)', unit: '', isLength: true },
  z: { label: 'Position z', unit: '', isLength: true },
  speed: { label: 'Speed', unit: '/s', isLength: true },
  acceleration: { label: 'Acceleration', unit: '/s²', isLength: true },
  angle: { label: 'Angle from rest', unit: '°', isLength: false },
  angularSpeed: { label: 'Angular speed', unit: '°/s', isLength: false },
  contact: { label: 'Foot contacts', unit: '', isLength: false },
};

/** A character whose take is measured, and its joints. */
export interface Source {
  readonly character: Character;
  readonly frames: Frames;
  /** Ascending or in the order of selection; of the same name in each character. */
  readonly joints: readonly number[];
}

export interface Measured {
  readonly source: Source;
  readonly tracks: Tracks;
}

export interface Series {
  readonly label: string;
  readonly frames: Frames;
  readonly values: Float64Array;
  /** Index of its character, and its own within that. */
  readonly source: number;
  readonly ordinal: number;
}

/**
 * The visible characters that show a take, or the two that are compared; with the selected joints, by name in all but
 * the selected character, or the topmost joint.
 */
export function sourcesOf(wb: Uses<'store' | 'timeline' | 'transport'>): readonly Source[] {
  const { document, selection } = wb.store;
  const comparison = wb.timeline.takes.comparison.get();
  const compared = comparedIn(document, comparison);
  const shownOnes = compared
    ? compared.map(
        ({ character, drawnAs }) =>
          drawnDocument(document, comparison).characters.find((c) => c.id === drawnAs) ?? character,
      )
    : document.characters.filter((c) => !c.isHidden);
  const selected = document.characters.find((c) => c.id === selection.characterId);
  const joints = jointsIn(selection).filter((j) => selected?.skeleton?.joints[j]);
  const { framesPerSecond } = wb.transport.get();
  return shownOnes.flatMap((character): Source[] => {
    const { skeleton } = character;
    const frames = measuredFrames(character, framesPerSecond);
    if (!skeleton?.joints.length || !frames) return [];
    if (!joints.length) return [{ character, frames, joints: [0] }];
    const own =
      skeleton === selected?.skeleton
        ? joints
        : joints
            .map((j) =>
              skeleton.joints.findIndex(({ name }) => name !== '' && name === selected?.skeleton?.joints[j].name),
            )
            .filter((j) => j >= 0);
    return [{ character, frames, joints: own }];
  });
}

/** Rows of one quantity. */
export function seriesOf(all: readonly Measured[], subject: Subject, quantity: Quantity): readonly Series[] {
  return all.flatMap(({ source: { character, frames, joints }, tracks }, source) => {
    const { skeleton } = character;
    const name = (own: string) => (all.length > 1 ? `${playedName(character)}: ${own}` : own);
    const named = (own: string, values: Float64Array | undefined, ordinal: number): Series[] =>
      values ? [{ label: name(own), frames, values, source, ordinal }] : [];
    if (quantity === 'contact') {
      return tracks.feet.flatMap((joint, i) => named(jointName(skeleton, joint), tracks.contacts[i], i));
    }
    const { frameSeconds } = frames;
    if (subject === 'mass')
      return named('Centre of mass', quantityOf({ positions: tracks.mass }, quantity, frameSeconds), 0);
    return (subject === 'feet' ? tracks.feet : joints).flatMap((joint, i) => {
      const at = tracks.joints.indexOf(joint);
      const motion = { positions: tracks.positions[at], rotations: tracks.rotations[at] };
      return named(jointName(skeleton, joint), quantityOf(motion, quantity, frameSeconds), i);
    });
  });
}

/** The times of all of them, seconds of the transport; undefined if there are none. */
export function spanOf(all: readonly Pick<Series, 'frames'>[]): readonly [number, number] | undefined {
  if (all.length === 0) return undefined;
  let [from, to] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  for (const { frames } of all) {
    from = Math.min(from, frames.startSeconds);
    to = Math.max(to, frames.startSeconds + (frames.frameCount - 1) * frames.frameSeconds);
  }
  return [from, to];
}

/** `m/s`; lengths are metres if every character states its unit. */
export function unitOf(all: readonly Pick<Measured, 'source'>[], quantity: Quantity): string {
  const { unit, isLength } = QUANTITY_LABELS[quantity];
  if (!isLength) return unit;
  const inMetres = all.every(({ source: { character } }) => character.space && character.space.unit !== 'asIs');
  return `${inMetres ? 'm' : 'units'}${unit}`;
}

/** Whether a take has more frames than any real one: its range is a mistake, or a clock's. */
export const isTooLong = ({ frames }: Source) => !(frames.frameCount <= MAX_FRAMES);

/** Why nothing is shown. */
export function emptyText(sources: readonly Source[], subject: Subject, quantity: Quantity): string {
  if (!sources.length) return 'No visible character has a take. Open one, or show its character.';
  if (sources.every(isTooLong)) {
    return `The take has more than ${count(MAX_FRAMES)} frames. Shorten its range in the inspector, or lower the frame rate.`;
  }
  if (quantity === 'contact' || subject === 'feet')
    return 'No feet were recognised: a leg needs a thigh, a shin and a foot.';
  if (subject === 'mass') return 'The centre of mass does not rotate. Choose joints, or another quantity.';
  return 'No character has the selected joints.';
}

/** How masses were assumed; empty unless they are shown. */
export function massText(all: readonly Measured[], subject: Subject, quantity: Quantity): string {
  if (subject !== 'mass' || quantity === 'contact' || !all.length) return '';
  const isBody = all.every(({ tracks }) => tracks.massModel === 'segments');
  const isNone = all.every(({ tracks }) => tracks.massModel === 'bones');
  if (isBody) return 'Masses of limb segments by de Leva (1996), men';
  return isNone
    ? 'Mass uniform over the bones'
    : 'Masses by de Leva (1996) where limbs are recognised, otherwise uniform over the bones';
}

/** Frames closer than this are the same row; seconds. */
const SAME_MOMENT = 1e-7;

/**
 * A column a series with exact numbers, a row a time of any of them; empty where a series has no frame, or a point is
 * missing.
 */
export function seriesAsCsv(all: readonly Series[], quantity: Quantity, unit: string): string {
  const { label } = QUANTITY_LABELS[quantity];
  const heads = all.map((one) => `${one.label} ${label.toLowerCase()}${unit && ` (${unit})`}`);
  const lines = [['time (s)', ...heads].map((head) => quoted(harmless(head))).join(',')];
  const next = all.map(() => 0);
  const timeOf = ({ frames }: Series, f: number) =>
    f < frames.frameCount ? frames.startSeconds + f * frames.frameSeconds : Number.POSITIVE_INFINITY;
  for (;;) {
    const time = all.reduce((least, one, i) => Math.min(least, timeOf(one, next[i])), Number.POSITIVE_INFINITY);
    if (time === Number.POSITIVE_INFINITY) break;
    const cells = all.map((one, i) => (timeOf(one, next[i]) - time < SAME_MOMENT ? cellOf(one.values[next[i]++]) : ''));
    lines.push([exact(time), ...cells].join(','));
  }
  return lines.map((line) => `${line}\r\n`).join('');
}

function cellOf(value: number): string {
  return Number.isNaN(value) ? '' : exact(value);
}

/** The value nearest in time; undefined beyond the ends, and where a point is missing. */
export function valueAt({ frames, values }: Series, timeSeconds: number): number | undefined {
  const at = (timeSeconds - frames.startSeconds) / frames.frameSeconds;
  const f = Math.round(at);
  const value = f >= 0 && f < frames.frameCount ? values[f] : Number.NaN;
  return Number.isNaN(value) ? undefined : value;
}

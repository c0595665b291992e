/** Shapes that several commands share. */

import type { PoseByNames } from '../../model/pose-by-names.ts';
import { EXTRAPOLATIONS } from '../../model/takes/take.ts';
import { NEW_KEY_TANGENTS, TANGENT_CHOICES, TANGENT_KINDS } from '../../model/takes/tangent-kinds.ts';
import { CommandError } from '../command-error.ts';
import type { KeyOptions } from '../key-dofs.ts';
import { COLLISIONS } from '../keys/arrange.ts';
import { OUTSIDE_CYCLE } from '../keys/cycle.ts';
import { TANGENT_SIDES } from '../keys/tangents.ts';
import { SKIN_MODES } from '../rig/rigging.ts';
import {
  boolean,
  filledText,
  index,
  list,
  number,
  oneOf,
  optional,
  record,
  type Shape,
  text,
  tuple,
  whole,
} from './shape.ts';

/** One character, by its id. */
export const CHARACTER = { characterId: text } as const;
/** A character at a time, in seconds of the transport. */
export const NOW = { ...CHARACTER, timeSeconds: number } as const;

const startAndEnd = tuple('start', 'end');
/** Two times, in order. */
export const range: typeof startAndEnd = {
  what: `${startAndEnd.what}, the start not after the end`,
  read(value, path) {
    const [start, end] = startAndEnd.read(value, path);
    if (start > end) throw new CommandError(`"${path}" must start before it ends, found ${start} to ${end}.`);
    return [start, end];
  },
};
/** Three finite numbers x y z. */
export const vector = tuple('x', 'y', 'z');
/** A `Placement`: turns in radians. */
export const placement = record({ position: vector, turn: vector, scale: number });

/** Treatment of a key outside a cycle; see `OUTSIDE_CYCLE`. */
export const outsideCycle = oneOf(OUTSIDE_CYCLE);
/**
 * How a DOF is keyed: kind of tangents, the playback range of a new take, what a key outside a cycle means, and whether
 * what is displayed is the stepped preview.
 */
export const KEY_OPTIONS = {
  tangents: optional(oneOf(NEW_KEY_TANGENTS)),
  playedRange: optional(range),
  outsideCycle: optional(outsideCycle),
  stepped: optional(boolean),
} as const;
const keyOptions: Shape<KeyOptions> = record(KEY_OPTIONS);
/** Auto-key. */
export const key = optional(keyOptions);

/** A `TangentSide`. */
export const side = oneOf(TANGENT_SIDES);
/** A `TangentKind`. */
export const tangentKind = oneOf(TANGENT_KINDS);
/** A `TangentChoice`. */
export const tangentChoice = oneOf(TANGENT_CHOICES.map(({ name }) => name));
/** An `Extrapolation`. */
export const extrapolation = oneOf(EXTRAPOLATIONS);

/** A list of whole numbers from 0. */
export const indices = list(index);
/** Channels of a character's shown take, by index. */
export const CHANNELS = { ...CHARACTER, channels: indices } as const;
/** Keys by channel and index. */
export const keys = list(record({ channel: index, indices }));
/** Keys of a character's shown take. */
export const KEYS = { ...CHARACTER, keys } as const;

/** A take of a character; -1 for its pose, -2 for the retargeted one. */
export const takeRef = record({ characterId: text, take: whole(-2) });

/** Takes of any characters. */
export const TAKES = { takes: list(takeRef) } as const;
/** The shown take unless another is given. */
export const TAKE = { ...CHARACTER, take: optional(index) } as const;
/** Characters by their ids. */
export const CHARACTERS = { characterIds: list(text) } as const;

/** Treatment of keys outside a cycle: `KeyPlacing`. */
export const PLACING = { outsideCycle: optional(outsideCycle), bakedRange: optional(range) } as const;
/** Treatment of a key that a moved one lands on; default: it is replaced. */
export const onCollision = optional(oneOf(COLLISIONS));

/**
 * Arguments that commands on a skeleton share; `timeSeconds` is the transport time of the displayed pose, default 0.
 */
export const RIGGING = { ...CHARACTER, skin: optional(oneOf(SKIN_MODES)), timeSeconds: optional(number) } as const;
/** A joint of a character, with what rigging is given. */
export const JOINT = { ...RIGGING, joint: index } as const;

const namedValues = list(record({ name: filledText, value: number }));
/** A `PoseByNames`. */
export const poseByNames: Shape<PoseByNames> = record({
  name: filledText,
  root: optional(vector),
  joints: list(record({ name: text, dofs: namedValues })),
  weights: namedValues,
});

/** Shapes that several commands share. */
import { EXTRAPOLATIONS, TANGENT_KINDS } from '../../model/clip.ts';
import { OUTSIDE_CYCLE } from '../keys/cycle.ts';
import { TANGENT_SIDES } from '../keys/tangents.ts';
import { index, list, number, oneOf, optional, record, text, tuple, whole } from './shape.ts';

/** Of one character, by its id. */
export const CHARACTER = { characterId: text } as const;
export const NOW = { ...CHARACTER, timeSeconds: number } as const;

export const range = tuple('start', 'end');
export const vector = tuple('x', 'y', 'z');
export const placement = record({ position: vector, turn: vector, scale: number });

export const outsideCycle = oneOf(OUTSIDE_CYCLE);
export const KEY_OPTIONS = {
  tangents: optional(oneOf(['smooth', 'linear', 'flat'])),
  playedRange: optional(range),
  outsideCycle: optional(outsideCycle),
} as const;
/** Auto-key. */
export const key = optional(record(KEY_OPTIONS));

export const side = oneOf(TANGENT_SIDES);
export const tangentKind = oneOf(TANGENT_KINDS);
export const extrapolation = oneOf(EXTRAPOLATIONS);

export const indices = list(index);
export const CHANNELS = { ...CHARACTER, channels: indices } as const;
export const keys = list(record({ channel: index, indices }));
export const KEYS = { ...CHARACTER, keys } as const;

/** A take of a character; -1 for its pose, -2 for the retargeted one. */
export const takeRef = record({ characterId: text, clip: whole(-2) });

/**
 * What the page knows beside the document. Kept apart by lifetime: the selection comes back with undo, display and
 * panels are remembered between visits, the time of the transport is neither.
 */

/** What is picked; indices are into the character's own lists. */
export interface Selection {
  readonly characterId?: string;
  /** Which of the character's copies was picked; absent where that does not matter, as in a list. */
  readonly placement?: number;
  readonly joint?: number;
  readonly vertex?: number;
  /** Keys of the clip that the character shows; absent where none is selected. */
  readonly keys?: readonly ChannelKeys[];
}

/** Some of a channel's keys. In a list of them each channel stands once, ascending, and none without a key. */
export interface ChannelKeys {
  readonly channel: number;
  /** Ascending, each once. */
  readonly indices: readonly number[];
}

export const NOTHING_SELECTED: Selection = {};

export type SkinStyle = 'hidden' | 'solid' | 'textured' | 'wire' | 'xray' | 'heat';
/** `bare`: solid, for characters that no skin is drawn of. */
export type BoxStyle = 'hidden' | 'bare' | 'wire' | 'solid';

export const GHOST_UNITS = ['seconds', 'frames'] as const;
export type GhostUnit = (typeof GHOST_UNITS)[number];
/** On each side of the time shown. */
export const MAX_GHOSTS = 20;

/** What is drawn, for all characters. */
export interface Display {
  readonly skin: SkinStyle;
  readonly boxes: BoxStyle;
  /** Spheres at the joints and cylinders between them. */
  readonly bones: boolean;
  readonly axes: boolean;
  /** Of joints. */
  readonly names: boolean;
  /** Over the heads of characters, where there are several. */
  readonly characterNames: boolean;
  readonly normals: boolean;
  readonly grid: boolean;
  readonly shadow: boolean;
  readonly orthographic: boolean;
  /** Selected joint's path over the played range. */
  readonly trail: boolean;
  /** The selected character at other times, before and after the one shown. */
  readonly ghosts: boolean;
  /** How many of them, 0 to `MAX_GHOSTS`. */
  readonly ghostsBefore: number;
  readonly ghostsAfter: number;
  /** From one ghost to the next, in `ghostStepIn`; above 0. */
  readonly ghostStep: number;
  readonly ghostStepIn: GhostUnit;
  /** Keeps the camera on the selected joint. */
  readonly follow: boolean;
  /** Cancels the root's travel over the ground. */
  readonly inPlace: boolean;
}

export const DEFAULT_DISPLAY: Display = {
  skin: 'textured',
  boxes: 'bare',
  bones: false,
  axes: false,
  names: false,
  characterNames: true,
  normals: false,
  grid: true,
  shadow: true,
  orthographic: false,
  trail: false,
  ghosts: false,
  ghostsBefore: 3,
  ghostsAfter: 3,
  ghostStep: 0.2,
  ghostStepIn: 'seconds',
  follow: false,
  inPlace: false,
};

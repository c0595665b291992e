/**
 * Page state beside the document, by lifetime: undo restores the selection; display and panels are remembered between
 * visits; the transport's time is neither.
 */

/** The selected joints and keys of one character, by indices into its own lists. */
export interface SelectedPart {
  readonly characterId?: string;
  /** Which instance of the character was picked; absent if that does not matter, as in a list. */
  readonly placement?: number;
  /** The active joint: the last of the selected ones. */
  readonly joint?: number;
  /** The other selected joints, in the order of selection, each once. Absent: none, as without `joint`. */
  readonly others?: readonly number[];
  readonly vertex?: number;
  /** Keys of the take that the character shows; absent if none is selected. */
  readonly keys?: readonly ChannelKeys[];
}

/** The active character with what is selected of it, and of others. */
export interface Selection extends SelectedPart {
  /** What is selected of other characters, in the order of selection, each character once. Absent: nothing. */
  readonly beside?: readonly SelectedPart[];
}

/** Some of a channel's keys. Lists of these contain each channel once, ascending, with at least one key each. */
export interface ChannelKeys {
  readonly channel: number;
  /** Ascending, each once. */
  readonly indices: readonly number[];
}

/** The selection without a character, joint or key. */
export const NOTHING_SELECTED: Selection = {};

/**
 * Two are heat maps: `heat` of the weights of the selected joint; `four` of how far off a program with four attachments
 * per vertex would be.
 */
export type SkinStyle = 'hidden' | 'solid' | 'textured' | 'wire' | 'xray' | 'heat' | 'four';
/** `bare`: solid, for characters drawn without a skin. */
export type BoxStyle = 'hidden' | 'bare' | 'wire' | 'solid';

/** Units of the distance between onion skins; `keys` are where they are, whatever the distance. */
export const GHOST_UNITS = ['seconds', 'frames', 'keys'] as const;
/** Unit of the distance between onion skins; see `GHOST_UNITS`. */
export type GhostUnit = (typeof GHOST_UNITS)[number];
/** Forms in which onion skins are drawn: as bones, or as the shown skin. */
export const GHOST_SHAPES = ['skeleton', 'skin'] as const;
/** On each side of the current time. */
export const MAX_GHOSTS = 20;

/** Display settings, for all characters. */
export interface Display {
  readonly skin: SkinStyle;
  readonly boxes: BoxStyle;
  /** Spheres at joints and cylinders between them. */
  readonly bones: boolean;
  /** A factor of the width of bones, 0.25 to 4. However thin, they stay a few pixels wide. */
  readonly boneThickness: number;
  readonly axes: boolean;
  /** Joint names. */
  readonly names: boolean;
  /** Above the characters' heads, if there are several. */
  readonly characterNames: boolean;
  readonly normals: boolean;
  readonly grid: boolean;
  readonly shadow: boolean;
  /** The floor is at the lowest point of characters whose origin is in their middle, instead of at 0. */
  readonly floorAtLowest: boolean;
  readonly orthographic: boolean;
  /** Motion path of the selected joint over the playback range. */
  readonly trail: boolean;
  /** Onion skin: the selected character before and after the current time. */
  readonly ghosts: boolean;
  /** Number of ghosts, 0 to `MAX_GHOSTS`. */
  readonly ghostsBefore: number;
  readonly ghostsAfter: number;
  /** Between ghosts, in `ghostStepIn`; greater than 0. */
  readonly ghostStep: number;
  readonly ghostStepIn: GhostUnit;
  readonly ghostsOf: (typeof GHOST_SHAPES)[number];
  /** Keeps the camera on the selected joint. */
  readonly follow: boolean;
  /** Moves the camera over the ground with the root: of the selected character, or of the only one. */
  readonly followRoot: boolean;
  /** Cancels the root's travel over the ground. */
  readonly inPlace: boolean;
  /** Keyed channels hold the value of their last key: to block poses. Never in pictures, videos or files. */
  readonly stepped: boolean;
}

/** The display settings of a first visit. */
export const DEFAULT_DISPLAY: Display = {
  skin: 'textured',
  boxes: 'bare',
  bones: false,
  boneThickness: 1,
  axes: false,
  names: false,
  characterNames: true,
  normals: false,
  grid: true,
  shadow: true,
  floorAtLowest: true,
  orthographic: false,
  trail: false,
  ghosts: false,
  ghostsBefore: 3,
  ghostsAfter: 3,
  ghostStep: 0.2,
  ghostStepIn: 'seconds',
  ghostsOf: 'skeleton',
  follow: false,
  followRoot: false,
  inPlace: false,
  stepped: false,
};

/**
 * The kinds of tangents, a record each: menus, buttons, shortcuts, handles, commands, the command line and files take
 * them from here.
 */

/** The record of a kind of tangent. */
export interface TangentRecord {
  /** In commands, scripts and, if `isWord`, in files. */
  readonly name: string;
  /** On buttons and in menus. */
  readonly label: string;
  /** Files say the name; of other kinds they say the slope as a number. */
  readonly isWord: boolean;
  /** Offered for new keys. */
  readonly isForNewKeys: boolean;
  /** Whether the slope follows the keys around it. */
  readonly follows: boolean;
}

/** In the order of their shortcuts. `Tangents.kinds` holds indices into this list, so it only ever grows. */
const RECORDS = [
  { name: 'flat', label: 'Flat', isWord: true, isForNewKeys: true, follows: false },
  { name: 'linear', label: 'Linear', isWord: true, isForNewKeys: true, follows: true },
  { name: 'smooth', label: 'Smooth', isWord: true, isForNewKeys: true, follows: true },
  { name: 'fixed', label: 'Fixed slope', isWord: false, isForNewKeys: false, follows: false },
  { name: 'auto', label: 'Auto', isWord: false, isForNewKeys: true, follows: true },
] as const satisfies readonly TangentRecord[];

/** The name of a kind of tangent. */
export type TangentKind = (typeof RECORDS)[number]['name'];
/** The kinds that new keys may have. */
export type NewKeyTangents = Extract<(typeof RECORDS)[number], { readonly isForNewKeys: true }>['name'];

/** The record of each kind, in the order of `TANGENT_KINDS`. */
export const TANGENTS: readonly (TangentRecord & { readonly name: TangentKind })[] = RECORDS;
/**
 * Kinds of tangents: slope 0; towards the neighbouring key; the slope between both neighbours; a slope of its own; a
 * slope that never overshoots (`auto-slope.ts`). `Tangents.kinds` holds indices into this list.
 */
export const TANGENT_KINDS: readonly TangentKind[] = RECORDS.map((record) => record.name);
/** The kinds that new keys may have, the default first. */
export const NEW_KEY_TANGENTS: readonly NewKeyTangents[] = ['smooth', 'auto', 'linear', 'flat'];

/**
 * The choices for a key: a kind of tangent, or `step`, which is none: the key holds its value up to the next one
 * (`edit/keys/steps.ts`). In the order of their shortcuts.
 */
export const TANGENT_CHOICES: readonly { readonly name: TangentChoice; readonly label: string }[] = [
  ...RECORDS,
  { name: 'step', label: 'Step' },
];
/** The name of a kind of tangent, or `step`. */
export type TangentChoice = TangentKind | 'step';

/** Index of `flat` in `TANGENT_KINDS`. */
export const FLAT = 0;
/** Index of `linear` in `TANGENT_KINDS`. */
export const LINEAR = 1;
/** Index of `smooth` in `TANGENT_KINDS`. */
export const SMOOTH = 2;
/** Index of `fixed`: a numeric tangent in the file, the slope itself. */
export const FIXED_TANGENT = 3;
/** Index of `auto`: in the file it is the number that the formula gives. */
export const AUTO_TANGENT = 4;

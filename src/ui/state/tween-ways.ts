/** What the tween bar does: a record for each key. */

/** A way to get values between keys. */
export interface TweenWay {
  readonly kind: TweenKind;
  readonly label: string;
  /** What its number means. */
  readonly text: string;
  readonly shortcut: string;
  /** Ends of the slider; any number may be typed. */
  readonly span: readonly [number, number];
  /** Where the slider is before it is moved. */
  readonly neutral: number;
  /** Values with a button. */
  readonly presets: readonly number[];
  /** What it applies to: the pose at the current time, or selected keys if there are any. */
  readonly of: 'pose' | 'keys' | 'both';
}

export const TWEEN_WAYS = [
  {
    kind: 'tween',
    label: 'Tween',
    text: '0: the key before, 1: the key after',
    shortcut: 'Shift+W',
    span: [-0.2, 1.2],
    neutral: 0.5,
    presets: [0, 0.5, 1],
    of: 'both',
  },
  {
    kind: 'rest',
    label: 'Toward file pose',
    text: '0: as shown, 1: the file pose',
    shortcut: 'Shift+Q',
    span: [-0.2, 1.2],
    neutral: 0,
    presets: [0, 0.5, 1],
    of: 'pose',
  },
  {
    kind: 'relax',
    label: 'Relax or push',
    text: '1: on the straight line between the keys, less than 0: pushed away from it',
    shortcut: 'Shift+X',
    span: [-1, 1],
    neutral: 0,
    presets: [-0.5, 0.5, 1],
    of: 'both',
  },
  {
    kind: 'ease',
    label: 'Ease',
    text: 'greater than 0: near the key before, less than 0: near the key after',
    shortcut: 'Shift+U',
    span: [-1, 1],
    neutral: 0,
    presets: [-0.5, 0, 0.5],
    of: 'keys',
  },
  {
    kind: 'scale',
    label: 'Scale values',
    text: 'factor about the first, last or mean key, or the file pose',
    shortcut: 'Shift+Z',
    span: [0, 2],
    neutral: 1,
    presets: [0, 0.5, 2],
    of: 'keys',
  },
] as const satisfies readonly (Omit<TweenWay, 'kind'> & { readonly kind: string })[];

export type TweenKind = (typeof TWEEN_WAYS)[number]['kind'];

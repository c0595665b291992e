/** Assumptions about the lines of each format, for the place of an error. Readers don't rely on any of it. */

/** Text files that are read, by their usual extension. */
export type TextKind = 'skel' | 'axskel' | 'skin' | 'morph' | 'anim' | 'rig' | 'bvh' | 'pose';

/** How the lines of one text format usually look: rows by block, and the words that open a line. */
export interface TextLayout {
  readonly kind: TextKind;
  /**
   * Numbers in a row of each block, by the word that starts the line above; `pairs`: a count, then two for each. '' is
   * for a file of rows alone.
   */
  readonly rows: ReadonlyMap<string, number | 'pairs'>;
  /** Words among the numbers of a row. */
  readonly words?: ReadonlySet<string>;
  /** Words that may be missing at the start of a line. */
  readonly keywords: readonly string[];
}

const NO_ROWS: TextLayout['rows'] = new Map();
const AXIS_ANGLE: TextLayout['rows'] = new Map([['', 6]]);

/** The layout of each text format that errors are located in. */
export const TEXT_LAYOUTS: { readonly [K in TextKind]: TextLayout } = {
  skel: { kind: 'skel', rows: AXIS_ANGLE, keywords: ['balljoint', 'offset', 'boxmin', 'pose', 'rotxlimit'] },
  axskel: { kind: 'axskel', rows: AXIS_ANGLE, keywords: [] },
  skin: {
    kind: 'skin',
    rows: new Map<string, number | 'pairs'>([
      ['positions', 3],
      ['normals', 3],
      ['texcoords', 2],
      ['skinweights', 'pairs'],
      ['triangles', 3],
      ['matrix', 3],
    ]),
    keywords: [
      'matrix',
      'positions',
      'normals',
      'texcoords',
      'skinweights',
      'triangles',
      'bindings',
      'material',
      'texture',
      'color',
    ],
  },
  morph: {
    kind: 'morph',
    rows: new Map([
      ['positions', 4],
      ['normals', 4],
    ]),
    keywords: ['positions', 'normals'],
  },
  anim: {
    kind: 'anim',
    rows: new Map([['keys', 4]]),
    words: new Set(['flat', 'linear', 'smooth']),
    keywords: ['channel', 'keys', 'extrapolate', 'range', 'numchannels', 'animation'],
  },
  rig: { kind: 'rig', rows: NO_ROWS, keywords: ['skeleton', 'skin', 'morphs', 'animation', 'rig'] },
  bvh: { kind: 'bvh', rows: NO_ROWS, keywords: ['JOINT', 'OFFSET', 'CHANNELS', 'End', 'ROOT', 'MOTION', 'HIERARCHY'] },
  pose: { kind: 'pose', rows: NO_ROWS, keywords: ['joint', 'root', 'weight', 'pose'] },
};

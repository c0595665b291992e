/**
 * The colours of everything drawn in the viewport, for both themes. Whatever must be read or followed (axes, labels,
 * selection) has a contrast of at least 4.5:1 with both ends of the background; tests measure it.
 *
 * Colours are sRGB, as in CSS. Lines, labels and background are drawn unchanged; lit surfaces go through
 * three.js's colour management and tone mapping.
 */
export type ThemeName = 'light' | 'dark';

/** The colours that tell two compared characters apart. */
export type Tint = 'comparedFirst' | 'comparedSecond';
/** By character id. */
export type Tints = ReadonlyMap<string, Tint>;
export const NO_TINTS: Tints = new Map();

export interface StageTheme {
  /** Background at the top of the viewport, at the horizon, and at the bottom. */
  readonly backgroundTop: string;
  readonly horizon: string;
  readonly backgroundBottom: string;
  /** How much darker the corners are, 0 to 1. */
  readonly vignette: number;
  /** Grid lines at the labelled spacing, and between them. */
  readonly gridMajor: string;
  readonly gridMinor: string;
  readonly gridMajorOpacity: number;
  readonly gridMinorOpacity: number;
  /** Light on the floor around what the camera looks at. */
  readonly pool: string;
  readonly poolOpacity: number;
  /** Numbers on the grid. */
  readonly gridLabel: string;
  readonly axisX: string;
  readonly axisY: string;
  readonly axisZ: string;
  /** Handles that move along an axis: those that turn about it have the axis' own colour. */
  readonly moveX: string;
  readonly moveY: string;
  readonly moveZ: string;
  /** Names of joints. */
  readonly label: string;
  /** Outline of labels, so that they are readable on anything. */
  readonly labelHalo: string;
  /** Joints and bones, lit. */
  readonly bone: string;
  /** Solid boxes, lit. */
  readonly box: string;
  /** Edges of boxes. */
  readonly boxEdge: string;
  readonly boxEdgeOpacity: number;
  /** The active joint. */
  readonly selected: string;
  /** Joints selected with it. */
  readonly selectedToo: string;
  readonly selectedLabel: string;
  /** The circle around a picked vertex, and a DOF's handle without an axis: the accent. */
  readonly vertex: string;
  readonly hovered: string;
  /** Pins, and the gaps to their targets. */
  readonly pin: string;
  readonly pinGap: string;
  /** Ghosts: earlier ones cool, later ones warm. */
  readonly ghostBefore: string;
  readonly ghostAfter: string;
  /** Two compared characters, with their skins: the colours beside their names in the list of takes. */
  readonly comparedFirst: string;
  readonly comparedSecond: string;
  readonly shadow: string;
  readonly shadowOpacity: number;
  /** Tone mapping exposure: a light background needs a little more. */
  readonly exposure: number;
}

export const STAGE_THEMES: Readonly<Record<ThemeName, StageTheme>> = {
  dark: {
    backgroundTop: '#25292d',
    horizon: '#363c42',
    backgroundBottom: '#1b1e21',
    vignette: 0.1,
    gridMajor: '#aab4c0',
    gridMinor: '#aab4c0',
    gridMajorOpacity: 0.2,
    gridMinorOpacity: 0.08,
    pool: '#8b95a1',
    poolOpacity: 0.16,
    gridLabel: '#98a1ab',
    axisX: '#ff8078',
    axisY: '#85cf63',
    axisZ: '#7fb2ff',
    moveX: '#ff94c2',
    moveY: '#4fd3a6',
    moveZ: '#5fcde4',
    label: '#b9c0c8',
    labelHalo: '#25282c',
    bone: '#cfd3d8',
    box: '#a8afb7',
    boxEdge: '#b4c2d1',
    boxEdgeOpacity: 0.6,
    selected: '#ff9a3c',
    selectedToo: '#d6852f',
    selectedLabel: '#ffad5e',
    vertex: '#a594ff',
    hovered: '#ffd9ad',
    pin: '#5fd6c3',
    pinGap: '#f2c14e',
    ghostBefore: '#6fb0ff',
    ghostAfter: '#ff9d6e',
    comparedFirst: '#56bdf2',
    comparedSecond: '#f48fb8',
    shadow: '#000000',
    shadowOpacity: 0.62,
    exposure: 1.04,
  },
  light: {
    backgroundTop: '#e9ecf0',
    horizon: '#f7f8fa',
    backgroundBottom: '#d9dde2',
    vignette: 0.04,
    gridMajor: '#3c4754',
    gridMinor: '#3c4754',
    gridMajorOpacity: 0.2,
    gridMinorOpacity: 0.09,
    pool: '#ffffff',
    poolOpacity: 0.6,
    gridLabel: '#4a535d',
    axisX: '#b5271f',
    axisY: '#2a6b17',
    axisZ: '#1f56bd',
    moveX: '#a81c66',
    moveY: '#0a674a',
    moveZ: '#0a6075',
    label: '#4a535d',
    labelHalo: '#eceef1',
    bone: '#97a1ac',
    box: '#a3abb4',
    boxEdge: '#3d4f63',
    boxEdgeOpacity: 0.62,
    selected: '#e8700a',
    selectedToo: '#a8561a',
    selectedLabel: '#9c4600',
    vertex: '#5b46d6',
    hovered: '#f2a861',
    pin: '#0a6b62',
    pinGap: '#7d5700',
    ghostBefore: '#2f74d6',
    ghostAfter: '#d2582a',
    comparedFirst: '#1b6fa8',
    comparedSecond: '#b52f6e',
    shadow: '#1d2733',
    shadowOpacity: 0.34,
    exposure: 1.12,
  },
};

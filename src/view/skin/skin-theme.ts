/** Colours of skins for both themes: CSS sRGB, before lighting. */
import type { ThemeName } from '../theme.ts';

export interface SkinTheme {
  /** The solid skin: unfired clay. */
  readonly clay: string;
  readonly wire: string;
  readonly wireOpacity: number;
  readonly xray: string;
  /** Opacity of the x-ray skin seen head-on, and at its silhouette. */
  readonly xrayFacing: number;
  readonly xrayEdge: number;
  /** Lines along the normals. */
  readonly normals: string;
}

export const SKIN_THEMES: Readonly<Record<ThemeName, SkinTheme>> = {
  dark: {
    clay: '#c2b3a3',
    wire: '#c3cdd8',
    wireOpacity: 0.55,
    xray: '#a9c6e8',
    xrayFacing: 0.07,
    xrayEdge: 0.75,
    normals: '#79c7d9',
  },
  light: {
    clay: '#c9b8a6',
    wire: '#39434e',
    wireOpacity: 0.6,
    xray: '#3f6a99',
    xrayFacing: 0.08,
    xrayEdge: 0.7,
    normals: '#1c7285',
  },
};

/** Lines, their names, and their visibility. */
import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { mixOklab } from '../../../../../src/math/oklab.ts';
import {
  axisColour,
  BASE_COLOURS,
  type BaseColour,
  cssColour,
  followingColour,
  mixed,
  otherColour,
} from '../../../../../src/ui/editors/curves/scene/colours.ts';
import { sceneLines } from '../../../../../src/ui/editors/curves/scene/scene.ts';
import { character, skeleton, take } from '../../../builders.ts';
import { keyed } from '../scenes.ts';

const hero = character({
  skeleton: skeleton(['hips', -1], ['leg', 0]),
  morphs: [
    {
      name: 'smile',
      positions: { indices: new Uint32Array(0), values: new Float64Array(0) },
      normals: { indices: new Uint32Array(0), values: new Float64Array(0) },
    },
  ],
  takes: [
    take(
      [0, 1],
      ...Array.from({ length: 12 }, (_, i) =>
        keyed([
          [0, i],
          [1, 3 * i],
        ]),
      ),
    ),
  ],
});

describe('lines', () => {
  it('lines are named by joint and DOF, by morph, or by number', () => {
    expect(sceneLines(hero, [0, 3, 8, 9, 10, 99], false).map((l) => l.name)).toEqual([
      'hips tx',
      'hips rx',
      'leg rz',
      'smile',
      'channel 10',
    ]);
  });

  it('lines use the axis of their unit, or all one between −1 and 1', () => {
    expect(sceneLines(hero, [0, 3, 9], false).map((l) => l.axis)).toEqual(['length', 'angle', 'weight']);
    const [line] = sceneLines(hero, [4], true);
    expect(line).toMatchObject({ axis: 'normalised', unit: 'angle' });
    const { scale, shift } = line.normalise ?? { scale: 0, shift: 0 };
    expect([4 * scale + shift, 12 * scale + shift]).toEqual([-1, 1]);
    expect(sceneLines(hero, [0], true)[0].normalise).toEqual({ scale: 1, shift: -0 });
  });

  it('lines keep a given scale: nothing rescales during a drag', () => {
    const kept = [{ ...sceneLines(hero, [4], true)[0], normalise: { scale: 7, shift: 1 } }];
    expect(sceneLines(hero, [4], true, kept)[0].normalise).toEqual({ scale: 7, shift: 1 });
  });

  it('lines have the limits of their DOF, if any', () => {
    expect(sceneLines(hero, [3], false)[0].limit).toBeUndefined();
    expect(sceneLines(hero, [9], false)[0].limit).toEqual({ min: 0, max: 1 });
  });

  it('lines distinguish joints', () => {
    const colours = sceneLines(hero, [3, 6], false).map((l) => cssColour(l.colour));
    expect(colours).toEqual(['var(--axis-x)', 'color-mix(in oklab, var(--axis-x), var(--text) 34%)']);
  });
});

const css = readFileSync(new URL('../../../../../src/ui/styles/tokens.css', import.meta.url), 'utf8');

function token(theme: string, name: string): string {
  return (
    css
      .split(`[data-theme="${theme}"] {`)[1]
      .split('}')[0]
      .match(new RegExp(`${name}: (#[0-9a-f]{6})`))?.[1] ?? ''
  );
}

function luminance(colour: string): number {
  const [r, g, b] = [1, 3, 5].map((at) => {
    const c = Number.parseInt(colour.slice(at, at + 2), 16) / 255;
    return c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
  });
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

describe.each(['dark', 'light'])('colours on the %s theme', (theme) => {
  const of = (base: BaseColour) => token(theme, BASE_COLOURS[base]);
  const palette = {
    x: of('x'),
    y: of('y'),
    z: of('z'),
    moveX: of('moveX'),
    moveY: of('moveY'),
    moveZ: of('moveZ'),
    accent: of('accent'),
    text: of('text'),
    faint: token(theme, BASE_COLOURS.faint),
  };

  it('linked DOFs look different from others', () => {
    const turned = axisColour('x', 0);
    const follows = followingColour(turned);
    expect(follows.dash).not.toEqual(turned.dash);
    expect(mixed(follows, palette)).not.toBe(mixed(turned, palette));
  });

  it('have 3:1 or more against the plot, inside the range and outside', () => {
    const all = Array.from({ length: 6 }, (_, i) => [
      axisColour('x', i),
      axisColour('y', i),
      axisColour('z', i),
      axisColour('x', i, true),
      axisColour('y', i, true),
      axisColour('z', i, true),
      otherColour(i),
    ]);
    for (const colour of all.flat()) {
      for (const ground of ['--plot', '--outside']) {
        const [low, high] = [luminance(mixed(colour, palette)), luminance(token(theme, ground))].sort((a, b) => a - b);
        expect((high + 0.05) / (low + 0.05)).toBeGreaterThanOrEqual(3);
      }
    }
  });

  it('no two lines shown together look alike', () => {
    const looks = Array.from({ length: 6 }, (_, i) =>
      [false, true]
        .flatMap((moves) => (['x', 'y', 'z'] as const).map((axis) => axisColour(axis, i, moves)))
        .map((c) => `${mixed(c, palette)} ${c.dash.length > 0}`),
    ).flat();
    expect(new Set(looks).size).toBe(looks.length);
  });
});

describe('mixing', () => {
  it('gives both ends back, and a grey between black and white', () => {
    expect(mixOklab('#a594ff', '#123456', 0)).toBe('#a594ff');
    expect(mixOklab('#a594ff', '#123456', 1)).toBe('#123456');
    // As in CSS: color-mix(in oklab, black, white).
    expect(mixOklab('#000000', '#ffffff', 0.5)).toBe('#636363');
  });
});

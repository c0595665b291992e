import { describe, expect, it } from 'vitest';
import { leaner } from '../vite.three.ts';

const ERROR = (what: string) => `#error ${what} is left out of the build: see vite.three.ts`;
const lines = (...text: string[]) => text.join('\n');

describe('the shaders of three.js in the built page', () => {
  it('say what is missing where a feature is used that was left out', () => {
    const glsl = lines(
      'a;',
      '#ifdef USE_SHEEN',
      '  b;',
      '  #ifdef USE_MAP',
      '    c;',
      '  #else',
      '  #endif',
      '#endif',
      'd;',
    );
    expect(leaner(glsl)).toBe(lines('a;', '#ifdef USE_SHEEN', ERROR('use_sheen'), '#endif', 'd;'));
  });

  it('the shaders of three.js in the built page keep what is compiled without the feature', () => {
    const glsl = lines('#ifdef USE_FOG', 'a;', '#elif defined( USE_SHEEN )', 'b;', '#else', 'c;', '#endif');
    expect(leaner(glsl)).toBe(
      lines(
        '#ifdef USE_FOG',
        ERROR('use_fog'),
        '#elif defined( USE_SHEEN )',
        ERROR('use_sheen'),
        '#else',
        'c;',
        '#endif',
      ),
    );
  });

  it('the shaders of three.js in the built page keep what is compiled with another feature too, or without this one', () => {
    for (const condition of [
      '#if defined( USE_UV ) || defined( USE_SHEEN )',
      '#ifndef USE_SHEEN',
      '#if ! defined( USE_SHEEN )',
      '#if NUM_SPOT_LIGHTS == 0',
      '#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES',
      '#ifdef USE_SHEENING',
    ]) {
      const glsl = lines(condition, 'a;', '#endif');
      expect(leaner(glsl)).toBe(glsl);
    }
  });

  it('leave out what needs a light of which there is none', () => {
    const condition = '#if ( NUM_SPOT_LIGHTS > 0 ) && defined( RE_Direct )';
    expect(leaner(lines(condition, 'a;', '#endif'))).toBe(lines(condition, ERROR('num_spot_lights'), '#endif'));
  });

  it('the shaders of three.js in the built page have no comments and no indentation', () => {
    expect(leaner('\ta; // one\n\n/* two\nthree */\tb;\n')).toBe('a;\nb;');
  });
});

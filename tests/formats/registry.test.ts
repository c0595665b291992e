import { describe, expect, it } from 'vitest';
import { FORMATS, formatOf, READABLE_EXTENSIONS } from '../../src/formats/registry.ts';

describe('the list of formats', () => {
  it('finds a format by the end of a name, in any case', () => {
    expect(formatOf('wasp.skel')?.kind).toBe('skel');
    expect(formatOf('a/b.c/WASP.Walk.ANIM')?.kind).toBe('anim');
    expect(formatOf('skin')).toBeUndefined();
    expect(formatOf('head.bmp')).toBeUndefined();
  });

  it('has each extension once', () => {
    expect(new Set(READABLE_EXTENSIONS).size).toBe(READABLE_EXTENSIONS.length);
  });

  it('writes only content of its own kind', () => {
    for (const format of FORMATS) {
      const foreign = format.kind === 'rig' ? ({ kind: 'skel', skeletons: [] } as const) : null;
      const content = foreign ?? ({ kind: 'rig', rig: { name: 'x', morphs: [] } } as const);
      expect(format.write(content, `x.${format.extensions[0]}`)).toBeUndefined();
    }
  });
});

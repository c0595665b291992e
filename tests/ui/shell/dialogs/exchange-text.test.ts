import { describe, expect, it } from 'vitest';
import type { ExchangeReport } from '../../../../src/export/shared/report.ts';
import { fileText, takesText } from '../../../../src/ui/shell/dialogs/exchange-text.ts';

const take = (name: string, keys = 7646) => ({ name, seconds: 6.4, channels: 31, keys });
const report = (more: Partial<ExchangeReport> = {}): ExchangeReport => ({
  bytes: 314_744,
  joints: 29,
  vertices: 2019,
  morphs: 1,
  takes: [take('walk')],
  size: 2.68,
  tolerance: 0.00134,
  losses: [],
  ...more,
});

describe('what is said of a GLB file before it is saved', () => {
  it('a GLB file is told with its size, its parts and its tolerance', () => {
    expect(fileText(report(), false)).toBe(
      '315 kB: 29 joints, 2,019 vertices, 1 morph. No joint or vertex is off by more than 0.0013 at any time.',
    );
    expect(fileText(report({ takes: [], morphs: 0 }), false)).toBe('315 kB: 29 joints, 2,019 vertices.');
    expect(fileText(report({ morphs: 0, vertices: 0 }), true)).toBe('315 kB: 29 joints. Exact at every frame.');
  });

  it('the keys of a GLB file are told by take, those of many takes together', () => {
    expect(takesText(report())).toBe('walk: 7,646 keys in 31 channels, 6.4 s');
    expect(takesText(report({ takes: [] }))).toBe('No take, only the pose.');
    const many = Array.from({ length: 7 }, (_, i) => take(`t${i}`, 10));
    expect(takesText(report({ takes: many })).split('\n')).toHaveLength(5);
    expect(takesText(report({ takes: many }))).toContain('3 further takes: 30 keys');
  });
});

import { expect, it } from 'vitest';
import type { Grade, GradedCause, PartGrade } from '../../src/cli/grade/grade.ts';
import { asHtml } from '../../src/cli/grade/html.ts';

const cause = (code: string, explains = 23): GradedCause => ({
  code,
  detail: '',
  sentence: `Of ${code}.`,
  formula: 'J',
  explains,
  of: 23,
});

/** The cells of the overview of a submission with these causes. */
function overview(causes: readonly GradedCause[]): string {
  const part: PartGrade = {
    files: ['ann/wasp.skel'],
    agrees: false,
    compared: { world: 23, local: 0, positions: 0, vertices: 0, normals: 0, channels: 0 },
    times: 1,
    frameTimes: [0.5],
    joints: 23,
    worst: 0.5,
    jointError: 0.5,
    vertexError: null,
    channels: null,
    mismatches: [],
    first: { what: 'joint', index: 7, name: 'hip', error: 0.5 },
    time: 0.5,
    own: ['hip'],
    inherited: [],
    causes,
  };
  const { agrees: _, ...facts } = part;
  const grade: Grade = {
    ...facts,
    name: 'ann',
    path: 'ann',
    verdict: 'wrong',
    loads: true,
    parts: [part],
    problems: [],
  };
  const html = asHtml([grade], { folder: 'class', reference: 'ref', tolerance: 1e-4, skipped: [] });
  return /<tbody>([\s\S]*?)<\/tbody>/.exec(html)?.[1] ?? '';
}

it('the overview of a class names all causes that explain the same, and none that explains less', () => {
  const equal = overview([cause('rotation-order'), cause('dof-order'), cause('no-parent', 20)]);
  expect(equal).toContain('<code>rotation-order</code> or <code>dof-order</code></td>');
  expect(overview([cause('rotation-order')])).toContain('<td><code>rotation-order</code></td>');
  expect(overview([])).toContain('none known');
});

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

/** The report about a submission with these causes. */
function report(causes: readonly GradedCause[], unexplained: readonly string[] = []): string {
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
    unexplained,
    shown: { what: 'Position', yours: [[1, 2, 3.5]], marrows: [[1, 2, 3]] },
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
  const date = new Date('2027-03-01T10:20:00Z');
  return asHtml([grade], { folder: 'class', reference: 'ref', tolerance: 1e-4, skipped: [], date });
}

/** The cells of the overview. */
function overview(causes: readonly GradedCause[]): string {
  return /<tbody>([\s\S]*?)<\/tbody>/.exec(report(causes))?.[1] ?? '';
}

it('the overview of a class names all causes that explain the same, and none that explains less', () => {
  const equal = overview([cause('rotation-order'), cause('dof-order'), cause('no-parent', 20)]);
  expect(equal).toContain('<code>rotation-order</code> or <code>dof-order</code></td>');
  expect(overview([cause('rotation-order')])).toContain(
    '<td>Of rotation-order. <span class="faint"><code>rotation-order</code></span></td>',
  );
  expect(overview([])).toContain('unknown');
});

it('a page says in sentences what is wrong first and why, with both numbers beside each other, and when', () => {
  const html = report([cause('rotation-order')]);
  expect(html).toContain('<time datetime="2027-03-01T10:20:00.000Z">1 March 2027');
  expect(html).toContain('First wrong: joint 7 &quot;hip&quot; at 0.5 s. Of rotation-order.');
  expect(html.replace(/<[^>]+>/g, ' ').replace(/\s+/g, ' ')).toContain(
    'Position, first wrong one Yours 1.0000 2.0000 3.5000 Marrow’s 1.0000 2.0000 3.0000',
  );
  expect(html.match(/class="differs"/g)).toHaveLength(2);
});

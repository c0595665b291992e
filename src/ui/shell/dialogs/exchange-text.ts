/** What the dialog for GLB says about a file before it is saved. */
import type { ExchangeReport } from '../../../export/shared/report.ts';
import { bytes, plural, shown } from '../../widgets/numbers/number-text.ts';

/** `walker_walk: 7,646 keys in 31 channels, 6.4 s`; one line per take, further ones summed up. */
export function takesText({ takes }: ExchangeReport): string {
  if (takes.length === 0) return 'No take, only the pose.';
  const lines = takes
    .slice(0, MAX_NAMED)
    .map(
      ({ name, keys, channels, seconds }) =>
        `${name}: ${plural(keys, 'key')} in ${plural(channels, 'channel')}, ${shown(seconds)} s`,
    );
  const rest = takes.slice(MAX_NAMED);
  if (rest.length) {
    const keys = rest.reduce((sum, take) => sum + take.keys, 0);
    lines.push(`${plural(rest.length, 'further take')}: ${plural(keys, 'key')}`);
  }
  return lines.join('\n');
}

const MAX_NAMED = 4;

/** `315 kB: 29 joints, 2,019 vertices, 3 morphs. No point is off by more than 0.001.` */
export function fileText(report: ExchangeReport, isExactAtFrames: boolean): string {
  const { joints, vertices, morphs, tolerance } = report;
  const parts = [
    ...(joints ? [plural(joints, 'joint')] : []),
    ...(vertices ? [plural(vertices, 'vertex', 'vertices')] : []),
    ...(morphs ? [plural(morphs, 'morph')] : []),
  ];
  const isAnimated = report.takes.some(({ keys }) => keys > 0);
  const within = `No joint or vertex is off by more than ${Number(tolerance.toPrecision(2))} at any time.`;
  const off = !isAnimated ? '' : isExactAtFrames ? ' Exact at every frame.' : ` ${within}`;
  return `${bytes(report.bytes)}: ${parts.join(', ')}.${off}`;
}

/** The legend of the plot while another program's channels are drawn over ours. */
import { element, write } from '../../widgets/dom.ts';
import type { CurveScene } from './scene/scene.ts';

const LABELS = { ours: 'Marrow’s', theirs: 'yours', differs: 'differs' } as const;

export class CurveLegend {
  readonly element = element(
    'div',
    { class: 'curve-legend', hidden: true },
    ...(['ours', 'theirs', 'differs'] as const).map((name) =>
      element('span', {}, element('span', { class: `curve-legend-line ${name}`, 'aria-hidden': 'true' }), LABELS[name]),
    ),
  );

  show({ theirs, lines }: CurveScene): void {
    const isHidden = !theirs || !lines.some(({ channel }) => theirs.has(channel));
    write(this.element, 'hidden', isHidden);
  }
}

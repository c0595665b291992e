/** The select tool: clicks pick, and every drag is the camera's. There is no gizmo. */

import { tryById } from '../../state/actions/action.ts';
import { setActionTooltip } from '../../state/actions/tooltips.ts';
import type { Workbench } from '../../state/workbench.ts';
import { element, keepsFocusElsewhere } from '../../widgets/dom.ts';
import type { ModeTool } from './mode-tool.ts';

const BACK = { pose: 'Back to Pose', fk: 'Back to FK', ik: 'Back to IK', rig: 'Back to rig' } as const;

export function selectTool(wb: Workbench): ModeTool {
  const back = keepsFocusElsewhere(element('button', { type: 'button', class: 'tool text-tool' }));
  back.addEventListener('click', () => tryById(wb, 'posing.selectTool'));
  setActionTooltip(wb, back, 'posing.selectTool', 'Leave the select tool');
  const group = element('div', { class: 'leave-select tools' }, back);
  const cursor = () => (wb.viewport.pointing.hovered ? 'pointer' : undefined);
  let stop = () => {};
  return {
    enter() {
      back.textContent = BACK[wb.posing.modeBeforeSelect];
      wb.posing.controls.set(group);
      stop = wb.viewport.pointing.onHover(() => {
        const { style } = wb.viewport.canvas;
        // Something else than a joint has the pointer: a key on a motion path.
        if (style.cursor !== 'grab') style.cursor = cursor() ?? '';
      });
    },
    leave() {
      stop();
      wb.posing.controls.set(undefined);
      wb.viewport.canvas.style.cursor = '';
    },
    press: () => undefined,
    hover: (at) => at && cursor(),
  };
}

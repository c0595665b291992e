/**
 * The viewport's tool in each mode. Each is a script of its own, fetched when its mode is first entered; FK, which the
 * page begins with, when the page is idle.
 */
import { onDemand, whenIdle } from '../on-demand.ts';
import type { PosingMode } from '../posing/posing.ts';
import type { Workbench } from '../workbench.ts';
import type { CanvasTool } from './canvas-tools.ts';
import type { ModeTool } from './mode-tool.ts';

async function load(wb: Workbench, mode: PosingMode): Promise<ModeTool> {
  switch (mode) {
    case 'fk':
      return (await import('./fk/fk-tool.ts')).fkTool(wb);
    case 'ik':
      return (await import('./ik/ik-tool.ts')).ikTool(wb);
    case 'rig':
      return (await import('./rig/rig-tool.ts')).rigTool(wb);
  }
}

const NAMES: Readonly<Record<PosingMode, string>> = { fk: 'Posing', ik: 'Inverse kinematics', rig: 'Rigging' };

/** The tool of the mode; undefined until it is there. */
export function modeTools(wb: Workbench): () => CanvasTool | undefined {
  const loaded = new Map<PosingMode, Promise<ModeTool | undefined>>();
  let current: ModeTool | undefined;
  let entered: PosingMode | undefined;
  const enter = async (mode: PosingMode) => {
    // The idle page comes to a mode that a person was quicker to enter.
    if (entered === mode) return;
    entered = mode;
    current?.leave();
    current = undefined;
    const loading = loaded.get(mode) ?? onDemand(wb.messages, NAMES[mode], () => load(wb, mode));
    loaded.set(mode, loading);
    const tool = await loading;
    if (!tool) {
      // What could not be fetched is asked for again the next time.
      loaded.delete(mode);
      if (entered === mode) entered = undefined;
    } else if (entered === mode && current !== tool) {
      current = tool;
      tool.enter();
    }
  };
  wb.posing.mode.subscribe((mode) => void enter(mode));
  whenIdle(wb, () => void enter(wb.posing.mode.get()));
  return () => current;
}

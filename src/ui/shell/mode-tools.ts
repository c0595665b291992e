/**
 * The viewport's tool in each mode. Each is a script of its own, fetched when its mode is first entered; FK, which the
 * page begins with, when the page is idle. A mode whose tool could not be fetched is left for FK, and asked for again
 * when it is chosen again.
 */
import type { CanvasTool } from '../editors/viewport/canvas-tools.ts';
import type { ModeTool } from '../editors/viewport/mode-tool.ts';
import { onDemand, whenIdle } from '../state/on-demand.ts';
import type { PosingMode } from '../state/posing.ts';
import type { Workbench } from '../state/workbench.ts';

async function fetchTool(wb: Workbench, mode: PosingMode): Promise<ModeTool> {
  switch (mode) {
    case 'fk':
      return (await import('../editors/fk/fk-tool.ts')).fkTool(wb);
    case 'ik':
      return (await import('../editors/ik/ik-tool.ts')).ikTool(wb);
    case 'rig':
      return (await import('../editors/rig/rig-tool.ts')).rigTool(wb);
  }
}

const NAMES: Readonly<Record<PosingMode, string>> = { fk: 'Posing', ik: 'Inverse kinematics', rig: 'Rigging' };

/**
 * The tool of the mode; undefined until it is there.
 * @param signal puts it down, with all that it listens to
 */
export function modeTools(wb: Workbench, signal: AbortSignal, load = fetchTool): () => CanvasTool | undefined {
  const loaded = new Map<PosingMode, Promise<ModeTool | undefined>>();
  let current: ModeTool | undefined;
  let entered: PosingMode | undefined;
  const leave = () => {
    current?.leave();
    current = undefined;
    entered = undefined;
  };
  const toolOf = (mode: PosingMode): Promise<ModeTool | undefined> => {
    const known = loaded.get(mode);
    if (known) return known;
    const loading = onDemand(wb.messages, NAMES[mode], () => load(wb, mode)).then((tool) => {
      // What could not be fetched is asked for again the next time.
      if (!tool) loaded.delete(mode);
      return tool;
    });
    loaded.set(mode, loading);
    return loading;
  };
  const enter = async (mode: PosingMode) => {
    // The idle page comes to a mode that a person was quicker to enter.
    if (entered === mode || signal.aborted) return;
    leave();
    entered = mode;
    const tool = await toolOf(mode);
    // Left meanwhile, or left and entered again, and then someone else who waited was first.
    if (entered !== mode || current) return;
    if (tool) {
      current = tool;
      tool.enter();
      return;
    }
    entered = undefined;
    // Not to be shown as being in a mode in which nothing can be done.
    wb.posing.mode.set('fk');
  };
  const stop = wb.posing.mode.subscribe((mode) => void enter(mode));
  whenIdle(wb, () => void enter(wb.posing.mode.get()));
  signal.addEventListener('abort', () => {
    stop();
    leave();
  });
  return () => current;
}

/**
 * The viewport's tool in each mode. Each is a script of its own, loaded when its mode is first entered; Pose, the
 * initial one, when the page is idle. If loading fails, the mode switches to Pose, and loading is retried when the mode
 * is chosen again.
 */
import type { CanvasTool } from '../editors/viewport/canvas-tools.ts';
import type { ModeTool } from '../editors/viewport/mode-tool.ts';
import { onDemand, whenIdle } from '../state/on-demand.ts';
import type { PosingMode } from '../state/posing.ts';
import type { Workbench } from '../state/workbench.ts';

async function fetchTool(wb: Workbench, mode: PosingMode): Promise<ModeTool> {
  switch (mode) {
    case 'select':
      return (await import('../editors/viewport/select-tool.ts')).selectTool(wb);
    case 'pose':
      return (await import('../editors/pose/pose-tool.ts')).poseTool(wb);
    case 'fk':
      return (await import('../editors/fk/fk-tool.ts')).fkTool(wb);
    case 'ik':
      return (await import('../editors/ik/ik-tool.ts')).ikTool(wb);
    case 'rig':
      return (await import('../editors/rig/rig-tool.ts')).rigTool(wb);
  }
}

const NAMES: Readonly<Record<PosingMode, string>> = {
  select: 'Selection',
  pose: 'Posing',
  fk: 'Forward kinematics',
  ik: 'Inverse kinematics',
  rig: 'Rigging',
};

/**
 * The mode's tool; undefined until loaded.
 *
 * @param signal removes it with its listeners
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
      // Retried the next time.
      if (!tool) loaded.delete(mode);
      return tool;
    });
    loaded.set(mode, loading);
    return loading;
  };
  const enter = async (mode: PosingMode) => {
    // The user has entered the mode before the page was idle.
    if (entered === mode || signal.aborted) return;
    leave();
    entered = mode;
    const tool = await toolOf(mode);
    // Left meanwhile, or left and entered again, in which case another call was first.
    if (entered !== mode || current) return;
    if (tool) {
      current = tool;
      tool.enter();
      return;
    }
    entered = undefined;
    // Don't stay in a mode without a tool.
    wb.posing.mode.set('pose');
  };
  const stop = wb.posing.mode.subscribe((mode) => void enter(mode));
  whenIdle(wb, () => void enter(wb.posing.mode.get()));
  signal.addEventListener('abort', () => {
    stop();
    leave();
  });
  return () => current;
}

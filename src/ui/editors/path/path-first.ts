/** What can be dragged on a motion path comes before what the mode's tool would take there. */
import type { Trail } from '../../../view/motion/trail.ts';
import { onDemand } from '../../state/on-demand.ts';
import type { Workbench } from '../../state/workbench.ts';
import type { CanvasTool } from '../viewport/canvas-tools.ts';

/**
 * The mode's tool, with the path first while one is shown. Its script is fetched then.
 *
 * @param tool the mode's; called each time
 */
export function pathFirst(
  wb: Workbench,
  trail: Trail,
  tool: () => CanvasTool | undefined,
): () => CanvasTool | undefined {
  let path: CanvasTool | undefined;
  let isLoading = false;
  const load = async () => {
    const module = await onDemand(wb.messages, 'The motion path', () => import('./path-tool.ts'));
    path = module && withPath(module.pathTool(wb, trail, tool), tool);
    // Retried the next time.
    isLoading = false;
  };
  return () => {
    if (!trail.held || wb.posing.mode.get() === 'rig') return tool();
    if (!path && !isLoading) {
      isLoading = true;
      void load();
    }
    return path ?? tool();
  };
}

function withPath(path: CanvasTool, tool: () => CanvasTool | undefined): CanvasTool {
  return {
    press: (at) => path.press(at) ?? tool()?.press(at),
    click: (at) => tool()?.click?.(at) ?? false,
    menu: (at) => tool()?.menu?.(at) ?? false,
    hover(at) {
      const cursor = path.hover?.(at);
      const others = tool()?.hover?.(cursor ? undefined : at);
      return cursor ?? others;
    },
  };
}

/** The viewport's tool in this mode. */
import type { Workbench } from '../../workbench.ts';
import type { ModeTool } from '../mode-tools.ts';

export function ikTool(_wb: Workbench): ModeTool {
  return { press: () => undefined, enter() {}, leave() {} };
}

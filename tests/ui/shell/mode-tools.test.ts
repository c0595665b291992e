import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import type { ModeTool } from '../../../src/ui/editors/viewport/mode-tool.ts';
import { modeTools } from '../../../src/ui/shell/mode-tools.ts';
import type { PosingMode } from '../../../src/ui/state/posing.ts';
import { workbench } from '../builders.ts';

let idle: (() => void)[];
beforeEach(() => {
  idle = [];
  vi.stubGlobal('window', { requestIdleCallback: (run: () => void) => void idle.push(run) });
});
afterEach(() => void vi.unstubAllGlobals());

/** Lets pending promises settle. */
const settled = async () => {
  for (let i = 0; i < 10; i++) await Promise.resolve();
};

/** Tools that load when the test says so. */
function page() {
  const { wb } = workbench();
  const log: string[] = [];
  const asked: { mode: PosingMode; arrive: () => void; fail: () => void }[] = [];
  const tool = (mode: PosingMode): ModeTool => ({
    press: () => undefined,
    enter: () => void log.push(`+${mode}`),
    leave: () => void log.push(`-${mode}`),
  });
  const stop = new AbortController();
  const current = modeTools(wb, stop.signal, (_wb, mode) => {
    return new Promise((resolve, reject) => {
      asked.push({ mode, arrive: () => resolve(tool(mode)), fail: () => reject(new Error('No network.')) });
    });
  });
  const latest = (mode: PosingMode) => {
    const found = asked.findLast((one) => one.mode === mode);
    if (!found) throw new Error(`Nobody asked for ${mode}.`);
    return found;
  };
  const { mode } = wb.posing;
  return {
    wb,
    log,
    mode,
    current,
    fetched: () => asked.map((one) => one.mode),
    arrive: (of: PosingMode) => {
      latest(of).arrive();
      return settled();
    },
    fail: (of: PosingMode) => {
      latest(of).fail();
      return settled();
    },
    becomeIdle: () => {
      for (const run of idle) run();
    },
    stop: () => stop.abort(),
  };
}

describe('the tool of the mode', () => {
  it('the tool of the mode is fetched when the page is idle, and entered when it is there', async () => {
    const { fetched, becomeIdle, arrive, log, current } = page();
    expect(fetched()).toEqual([]);
    becomeIdle();
    expect(current()).toBeUndefined();
    await arrive('pose');
    expect(log).toEqual(['+pose']);
    expect(current()).toBeDefined();
  });

  it('the tool of the mode is the one of the mode that was chosen before the page was idle', async () => {
    const { mode, becomeIdle, fetched, arrive, log } = page();
    mode.set('ik');
    becomeIdle();
    await arrive('ik');
    expect(fetched()).toEqual(['ik']);
    expect(log).toEqual(['+ik']);
  });

  it('the tool of the mode is put down when another mode is chosen, and fetched only once', async () => {
    const { mode, becomeIdle, arrive, log, fetched } = page();
    becomeIdle();
    await arrive('pose');
    mode.set('rig');
    expect(log).toEqual(['+pose', '-pose']);
    await arrive('rig');
    mode.set('pose');
    await settled();
    expect(log).toEqual(['+pose', '-pose', '+rig', '-rig', '+pose']);
    expect(fetched()).toEqual(['pose', 'rig']);
  });

  it('the tool of the mode is not entered where it comes after its mode was left', async () => {
    const { mode, arrive, log, current } = page();
    mode.set('ik');
    mode.set('rig');
    await arrive('rig');
    await arrive('ik');
    expect(log).toEqual(['+rig']);
    expect(current()).toBeDefined();
  });

  it('the tool of the mode is entered once where its mode was left and chosen again meanwhile', async () => {
    const { mode, arrive, log, fetched } = page();
    mode.set('ik');
    mode.set('rig');
    mode.set('ik');
    await arrive('ik');
    expect(log).toEqual(['+ik']);
    expect(fetched()).toEqual(['ik', 'rig']);
  });

  it('could not be fetched: that is said, Pose is gone back to, and choosing it again asks again', async () => {
    const { wb, mode, becomeIdle, arrive, fail, log, fetched } = page();
    becomeIdle();
    await arrive('pose');
    mode.set('ik');
    await fail('ik');
    expect(mode.get()).toBe('pose');
    expect(wb.messages.list.get().map(({ severity }) => severity)).toEqual(['error']);
    expect(log).toEqual(['+pose', '-pose', '+pose']);
    mode.set('ik');
    await arrive('ik');
    expect(log.slice(3)).toEqual(['-pose', '+ik']);
    expect(fetched()).toEqual(['pose', 'ik', 'ik']);
  });

  it('could not be fetched after its mode was left: the mode that is there stays', async () => {
    const { mode, arrive, fail, log } = page();
    mode.set('ik');
    mode.set('rig');
    await arrive('rig');
    await fail('ik');
    expect(mode.get()).toBe('rig');
    expect(log).toEqual(['+rig']);
  });

  it('the tool of the mode is asked for again where Pose itself could not be fetched', async () => {
    const { mode, becomeIdle, arrive, fail, log } = page();
    becomeIdle();
    await fail('pose');
    expect(mode.get()).toBe('pose');
    mode.set('ik');
    await arrive('ik');
    mode.set('pose');
    await arrive('pose');
    expect(log).toEqual(['+ik', '-ik', '+pose']);
  });

  it('the tool of the mode is put down with the page, and none comes after', async () => {
    const { mode, becomeIdle, arrive, log, current, stop, fetched } = page();
    becomeIdle();
    await arrive('pose');
    stop();
    expect(log).toEqual(['+pose', '-pose']);
    expect(current()).toBeUndefined();
    mode.set('ik');
    await settled();
    expect(fetched()).toEqual(['pose']);
  });

  it('the tool of the mode is not entered where it comes after the page is gone', async () => {
    const { mode, arrive, log, stop } = page();
    mode.set('ik');
    stop();
    await arrive('ik');
    expect(log).toEqual([]);
  });
});

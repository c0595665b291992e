import { describe, expect, it } from 'vitest';
import { runAction } from '../../../src/ui/state/actions/action.ts';
import { menuEntries } from '../../../src/ui/state/actions/menu-entries.ts';
import { workbench } from '../builders.ts';

function helpMenu() {
  const { wb } = workbench();
  const labels = () => menuEntries(wb, 'Help').flatMap((entry) => ('label' in entry ? [entry.label] : []));
  return { wb, labels };
}

describe('the Help menu of the installed page', () => {
  it('the Help menu offers to install the page only while the browser does', () => {
    const { wb, labels } = helpMenu();
    expect(labels()).not.toContain('Install Marrow…');
    let installs = 0;
    wb.offline.set({ isReady: false, install: () => void installs++ });
    expect(labels()).toContain('Install Marrow…');
    runAction(wb, 'help.install');
    expect(installs).toBe(1);
  });

  it('the Help menu offers a new version, also one that was put off', () => {
    const { wb, labels } = helpMenu();
    expect(labels()).not.toContain('Reload for new version');
    let reloads = 0;
    wb.offline.set({
      isReady: true,
      newVersion: { isPutOff: true, reload: () => void reloads++, later: () => {} },
    });
    expect(labels()).toContain('Reload for new version');
    runAction(wb, 'help.newVersion');
    expect(reloads).toBe(1);
  });
});

/** Actions for panels, theme, units and help. */
import { jointName } from '../../model/skeleton/joint-name.ts';
import { VERSION } from '../../model/version.ts';
import { needs } from '../state/actions/needs.ts';
import { selectedJoint } from '../state/joints/selected-joint.ts';
import { onDemand } from '../state/on-demand.ts';
import { isPanelOpen, openPanel } from '../state/panels/panels.ts';
import type { Settings } from '../state/settings.ts';
import { shownTabs, TIMELINE_TABS, type TimelineTabName } from '../state/timeline.ts';
import type { Action, Uses } from '../state/workbench.ts';
import { enterRegion, focusNextRegion, focusSection } from '../widgets/focus/focus-regions.ts';
import { TABS } from './timeline/timeline-tabs.ts';

const setting = (wb: Uses<'settings'>, change: Partial<Settings>) => wb.settings.update((s) => ({ ...s, ...change }));
export const PAGE_ACTIONS: readonly Action[] = [
  {
    id: 'page.outliner',
    label: 'Outliner',
    group: 'Page',
    menu: 'View',
    section: 3,
    shortcuts: ['Shift+T'],
    icon: 'outliner',
    checked: (wb) => isPanelOpen(wb.settings.get(), 'outliner'),
    run: (wb) => openPanel(wb, 'outliner', !isPanelOpen(wb.settings.get(), 'outliner')),
  },
  {
    // Pressed twice, or with the first letters of a name behind it, it hides nothing and runs nothing else.
    id: 'page.toOutliner',
    label: 'Go to outliner, to type a name; Esc goes back',
    group: 'Page',
    shortcuts: ['T'],
    quiet: true,
    run(wb) {
      openPanel(wb, 'outliner', true);
      enterRegion('outliner');
    },
  },
  {
    id: 'page.inspector',
    label: 'Inspector',
    group: 'Page',
    menu: 'View',
    section: 3,
    shortcuts: ['P'],
    icon: 'inspector',
    checked: (wb) => isPanelOpen(wb.settings.get(), 'inspector'),
    run: (wb) => openPanel(wb, 'inspector', !isPanelOpen(wb.settings.get(), 'inspector')),
  },
  {
    id: 'page.timeline',
    label: 'Timeline',
    group: 'Page',
    menu: 'View',
    section: 3,
    shortcuts: ['C'],
    icon: 'take',
    checked: (wb) => isPanelOpen(wb.settings.get(), 'timeline'),
    run: (wb) => openPanel(wb, 'timeline', !isPanelOpen(wb.settings.get(), 'timeline')),
  },
  ...TIMELINE_TABS.map(tabAction),
  {
    id: 'page.details',
    name: 'Show details of selection',
    label(wb) {
      const selected = selectedJoint(wb);
      return `Show details of ${selected ? jointName(selected.skeleton, selected.joint) : 'selection'}`;
    },
    group: 'Page',
    menu: 'View',
    section: 3,
    also: 'facts matrices numbers copy',
    refuses: needs('Select a joint or vertex first.', ({ store }: Uses<'store'>) => {
      const { joint, vertex } = store.selection;
      return (joint ?? vertex) !== undefined;
    }),
    run(wb) {
      openPanel(wb, 'inspector', true);
      wb.settings.update((s) => ({ ...s, folds: { ...s.folds, 'inspector/facts': true } }));
      focusSection('facts');
    },
  },
  {
    id: 'page.viewportOnly',
    label: 'Toggle side panels',
    group: 'Page',
    shortcuts: ['Ctrl+\\'],
    run(wb) {
      const now = wb.settings.get();
      const open = !(isPanelOpen(now, 'outliner') || isPanelOpen(now, 'inspector'));
      openPanel(wb, 'inspector', open);
      openPanel(wb, 'outliner', open);
    },
  },
  panelKey('page.nextPanel', 'Go to next panel', 'F6', 1),
  panelKey('page.previousPanel', 'Go to previous panel', 'Shift+F6', -1),
  choice('theme', 'system', 'System', 'View/Theme', 'background colour'),
  choice('theme', 'light', 'Light', 'View/Theme', 'background colour white bright'),
  choice('theme', 'dark', 'Dark', 'View/Theme', 'background colour black mode'),
  choice('angles', 'degrees', 'Degrees', 'View/Angles'),
  choice('angles', 'radians', 'Radians', 'View/Angles'),
  choice('timeDisplay', 'seconds', 'Seconds', 'View/Time'),
  choice('timeDisplay', 'frames', 'Frames', 'View/Time'),
  {
    id: 'page.otherAngles',
    label: 'Toggle degrees and radians',
    group: 'Page',
    shortcuts: ['D'],
    run: (wb) => setting(wb, { angles: wb.settings.get().angles === 'degrees' ? 'radians' : 'degrees' }),
  },
  {
    id: 'help.manual',
    label: 'Manual',
    detail: 'By key, the page about the active panel or dialog',
    group: 'Page',
    menu: 'Help',
    shortcuts: ['F1'],
    also: 'documentation guide reference tutorial',
    inDialogs: true,
    async run(wb, by) {
      const manual = await onDemand(wb.messages, 'The manual', () => import('./help/manual.ts'));
      manual?.openManual(wb, by === 'key');
    },
  },
  {
    id: 'help.firstAnimation',
    label: 'First animation',
    detail: 'Steps that tick themselves off',
    group: 'Page',
    menu: 'Help',
    section: 1,
    also: 'tutorial tour getting started introduction first steps hint',
    run: (wb) => wb.guide.set('firstAnimation'),
  },
  {
    id: 'help.checkProgram',
    label: 'Check your program',
    detail: 'Compares its numbers, step by step',
    group: 'Page',
    menu: 'Help',
    section: 1,
    also: 'tutorial compare homework mistake bug dump',
    run: (wb) => wb.guide.set('checkProgram'),
  },
  {
    id: 'help.search',
    label: 'Find a command…',
    group: 'Page',
    menu: 'Help',
    shortcuts: ['Ctrl+K', 'F3'],
    icon: 'search',
    run: (wb) => wb.dialog.set('search'),
  },
  {
    id: 'help.shortcuts',
    label: 'Shortcuts',
    group: 'Page',
    menu: 'Help',
    shortcuts: ['?'],
    run: (wb) => wb.dialog.set('shortcuts'),
  },
  {
    id: 'help.programs',
    label: 'Other programs',
    also: 'blender unity unreal godot maya gltf fbx vrm versions export import',
    group: 'Page',
    menu: 'Help',
    run: (wb) => wb.dialog.set('programs'),
  },
  {
    id: 'help.about',
    label: `About Marrow ${VERSION}`,
    group: 'Page',
    menu: 'Help',
    section: 3,
    run: (wb) => wb.dialog.set('about'),
  },
];

/** As long as there is something to install, or a new version. */
export function offlineActions(wb: Uses<'offline'>): Action[] {
  const { install, newVersion } = wb.offline.get();
  const found: Action[] = [];
  if (install) {
    found.push({
      id: 'help.install',
      label: 'Install Marrow…',
      detail: 'Opens in its own window and opens files from the system',
      group: 'Page',
      menu: 'Help',
      section: 2,
      also: 'app desktop offline',
      run: () => install(),
    });
  }
  if (newVersion) {
    found.push({
      id: 'help.newVersion',
      label: 'Reload for new version',
      group: 'Page',
      menu: 'Help',
      section: 1,
      also: 'update',
      run: () => newVersion.reload(),
    });
  }
  return found;
}

/** Shows a tab of the timeline, under the name of the tab. */
function tabAction(tab: TimelineTabName): Action {
  return {
    id: `page.tab.${tab}`,
    label: TABS[tab].label,
    group: 'Page',
    menu: 'View/Timeline tab',
    section: 3,
    radio: true,
    checked: (wb) => isPanelOpen(wb.settings.get(), 'timeline') && shownTabs(wb.timeline.view.get()).includes(tab),
    run(wb) {
      openPanel(wb, 'timeline', true);
      wb.timeline.change({ tab });
    },
  };
}

function panelKey(id: string, label: string, shortcut: string, step: 1 | -1): Action {
  return { id, label, group: 'Page', shortcuts: [shortcut], quiet: true, run: () => focusNextRegion(step) };
}

function choice<K extends 'theme' | 'angles' | 'timeDisplay'>(
  key: K,
  value: Settings[K],
  label: string,
  menu: NonNullable<Action['menu']>,
  also?: string,
): Action {
  return {
    id: `page.${key}.${value}`,
    label,
    group: 'Page',
    menu,
    section: 4,
    ...(also !== undefined && { also }),
    radio: true,
    checked: (wb) => wb.settings.get()[key] === value,
    run: (wb) => wb.settings.update((s) => ({ ...s, [key]: value })),
  };
}

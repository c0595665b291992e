/** The tabs below the viewport: labels, and scripts, loaded when first shown. */
import type { Document } from '../../../model/document.ts';
import type { TimelineTab, TimelineTabName } from '../../state/timeline.ts';
import type { Workbench } from '../../state/workbench.ts';

export interface TabRecord {
  readonly label: string;
  /** Whether there is anything to show; otherwise it is listed only while it is the current one. Default: always. */
  isListed?(document: Document): boolean;
  load(wb: Workbench): Promise<TimelineTab>;
}

export const TABS: Readonly<Record<TimelineTabName, TabRecord>> = {
  curves: {
    label: 'Curve editor',
    load: async (wb) => (await import('../../editors/curves/panel.ts')).curvePanel(wb),
  },
  dope: {
    label: 'Dope sheet',
    load: async (wb) => (await import('../../editors/dope/panel.ts')).dopePanel(wb),
  },
  takes: {
    label: 'Takes',
    load: async (wb) => (await import('../../editors/takes/panel.ts')).takesPanel(wb),
  },
  review: {
    label: 'Review',
    isListed: ({ review }) => review !== undefined,
    load: async (wb) => (await import('../../editors/review/panel.ts')).reviewPanel(wb),
  },
  poses: {
    label: 'Pose library',
    load: async (wb) => (await import('../../editors/poses/panel.ts')).posesPanel(wb),
  },
  measure: {
    label: 'Measure',
    load: async (wb) => (await import('../../editors/measure/panel.ts')).measurePanel(wb),
  },
  steps: {
    label: 'Steps',
    load: async (wb) => (await import('../../editors/steps/panel.ts')).stepsPanel(wb),
  },
  source: {
    label: 'Source',
    load: async (wb) => (await import('../../editors/source/panel.ts')).sourcePanel(wb),
  },
  compare: {
    label: 'Compare',
    load: async (wb) => (await import('../../editors/compare/panel.ts')).comparePanel(wb),
  },
};

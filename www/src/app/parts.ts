// What the page is made of, and what its works share.
import type { AlignmentByPicks } from "../alignment/byPicks.ts";
import type { AnnotationList } from "../annotations/list.ts";
import type { CheckPanel } from "../check/checkPanel.ts";
import type { ClearancePanel } from "../clearance/clearancePanel.ts";
import type { Views } from "../export/views.ts";
import type { FacesPanel } from "../faces/facesPanel.ts";
import type { FaceTree } from "../faces/faceTree.ts";
import type { FactsPanel } from "../facts/factsPanel.ts";
import type { OverlapPanel } from "../facts/overlapPanel.ts";
import type { PickingTool } from "../inspection/pickingTool.ts";
import type { Probing } from "../inspection/pins/probing.ts";
import type { PlaceView } from "../inspection/places/placeView.ts";
import type { MeasureList } from "../measuring/list.ts";
import type { Measuring } from "../measuring/tool.ts";
import type { View } from "../scene/view.ts";
import type { History } from "../state/history.ts";
import type { Client } from "../worker/client.ts";

export interface Parts {
  client: Client;
  view: View;
  faces: FacesPanel;
  tree: FaceTree;
  probing: Probing;
  measuring: Measuring;
  measureList: MeasureList;
  annotating: PickingTool;
  annotationList: AnnotationList;
  aligning: AlignmentByPicks;
  places: PlaceView;
  views: Views;
  clearance: ClearancePanel;
  facts: FactsPanel;
  overlap: OverlapPanel;
  check: CheckPanel;
  past: History;
}

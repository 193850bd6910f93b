// What tests read: counters of the drawing, and how much is drawn.
import type { Viewer } from "./viewer.ts";

export function set_test_hooks(viewer: Viewer): void {
  Object.assign(window, {
    cleancolor: {
      viewer,
      counters: viewer.stage.counters,
      settled: () => viewer.stage.settled(),
      counts: () => viewer.sides.map((s) => ({
        moves: s.moves.count, layers: s.moves.layer_z.length, tool_changes: s.moves.tool_change_move.length, places: s.audit?.places.count ?? 0, defects: s.audit?.worst.length ?? 0, ...s.view.counts(),
      })),
      /** Where a point of the first print (mm) is on the screen, CSS pixels of the picture. */
      project(x: number, y: number, z: number): [number, number] {
        const { camera, canvas } = viewer.stage;
        camera.updateMatrixWorld();
        const p = viewer.marker.object.position.clone().set(x, y, z).project(camera);
        return [((p.x + 1) / 2) * canvas.clientWidth, ((1 - p.y) / 2) * canvas.clientHeight];
      },
    },
  });
}

import "PACKAGE";
import "nurbs-hausdorff/worker/thread";

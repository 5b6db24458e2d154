"""Contact of a rough solid with a hard wall without adhesion, by boundary elements."""

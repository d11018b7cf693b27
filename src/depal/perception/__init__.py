"""From pictures to boxes: detection, recognition, poses, relations."""

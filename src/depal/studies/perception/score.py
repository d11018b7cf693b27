"""What one look got right; scores of many looks add up."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from depal.perception.faces import Facing, Look
from depal.studies.perception.boxes import all_faces, match_boxes
from depal.studies.perception.identity import Identities, identities
from depal.studies.perception.matching import Matching, match_faces
from depal.studies.perception.poses import PoseError, pose_error
from depal.studies.perception.relations import RelationCounts, judged, true_relations
from depal.studies.perception.truth import Truth
from depal.studies.statistics import Share


@dataclass(frozen=True, slots=True)
class Detected:
    """Of the faces that look one way.

    Attributes:
        right: detections that are faces, of those that are not ignored.
        found: faces that were found, of those that count.
        ignored: detections of faces of which too little is seen to be asked for.
    """

    right: Share = field(default_factory=Share)
    found: Share = field(default_factory=Share)
    ignored: int = 0

    def __add__(self, other: "Detected") -> "Detected":
        """Both together."""
        return Detected(
            self.right + other.right, self.found + other.found, self.ignored + other.ignored
        )


@dataclass(frozen=True, slots=True)
class Score:
    """Of one or many looks.

    Attributes:
        looks: how many.
        detected: by the way that faces look.
        poses: of the faces that were found.
        names: what was believed about the boxes that were found.
        on_top: what stands on what, between boxes that were found.
        occludes: what hides what, between boxes that were found.
    """

    looks: int = 0
    detected: Mapping[Facing, Detected] = field(
        default_factory=lambda: {facing: Detected() for facing in Facing}
    )
    poses: tuple[PoseError, ...] = ()
    names: Identities = field(default_factory=Identities)
    on_top: RelationCounts = field(default_factory=RelationCounts)
    occludes: RelationCounts = field(default_factory=RelationCounts)

    def __add__(self, other: "Score") -> "Score":
        """Both together."""
        return Score(
            self.looks + other.looks,
            {facing: self.detected[facing] + other.detected[facing] for facing in Facing},
            self.poses + other.poses,
            self.names + other.names,
            self.on_top + other.on_top,
            self.occludes + other.occludes,
        )


def scored(look: Look, truth: Truth) -> Score:
    """Compares what was seen with what is there."""
    faces = all_faces(look)
    matching = match_faces(faces, truth.faces)
    boxes, again = match_boxes(look, truth, faces, matching)
    on_top, occludes = true_relations([box.shape for box in truth.boxes])
    blocked = {lower for _, lower in (*on_top.asked, *occludes.asked)}
    return Score(
        1,
        {
            facing: _detected(
                [face.facing is facing for face in faces],
                [face.facing is facing for face in truth.faces],
                matching,
            )
            for facing in Facing
        },
        tuple(
            pose_error(faces[found], truth.faces[true], grasp=truth.faces[true].box not in blocked)
            for found, true in matching.pairs
        ),
        identities(look.boxes, truth.boxes, boxes, again),
        judged(look.on_top, on_top, boxes),
        judged(look.occludes, occludes, boxes),
    )


def _detected(found: list[bool], true: list[bool], matching: Matching) -> Detected:
    """The counts of one way of looking.

    Args:
        found: which detections look that way.
        true: which true faces do.
        matching: of all.
    """
    right = sum(found[face] for face, _ in matching.pairs)
    wrong = sum(found[face] for face in matching.wrong)
    missed = sum(true[face] for face in matching.missed)
    ignored = sum(found[face] for face, _ in matching.ignored)
    return Detected(Share(right, right + wrong), Share(right, right + missed), ignored)

"""The executive: hierarchical task schemata, evaluated continuously, executed concurrently.

It knows no box and no robot, and could be a library of its own. Source: section II-B.
"""

"""Where the parts meet: what a command does, from its options to its report."""

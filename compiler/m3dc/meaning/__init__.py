"""From the tree to records: the checked program, its evaluation, and what is right but probably not meant."""

// Filled in by the parts to come.

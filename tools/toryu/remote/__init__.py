"""Programs of a run that are on other hosts: started there, fed with the case, and their results brought back."""

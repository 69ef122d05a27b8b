"""The report of a run while it runs: a server of one page on this machine's loopback."""

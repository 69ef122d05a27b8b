"""What several folders of tests share: starting the programs, made-up results, stand-ins."""

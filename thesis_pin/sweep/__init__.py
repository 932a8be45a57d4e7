"""One robot asked about in thousands of sizes: designs, who works them out, which are best."""

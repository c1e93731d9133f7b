import sys

from piblocks import Scene

Scene(digits=3).render(sys.argv[1])

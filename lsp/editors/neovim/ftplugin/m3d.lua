require("mirage3d").attach(0)

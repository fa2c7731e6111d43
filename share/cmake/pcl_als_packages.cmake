# Packages that the public headers need; shared by the build and by the installed package config.
find_package(Threads REQUIRED)
find_package(Eigen3 3.3 REQUIRED NO_MODULE)
find_package(PCL 1.12 REQUIRED COMPONENTS common io kdtree search filters registration)

//! The papers and books the code cites.
//!
//! * **Spin-It**: M. Bächer, E. Whiting, B. Bickel, O. Sorkine-Hornung, "Spin-It: Optimizing Moment
//!   of Inertia for Spinnable Objects", ACM Transactions on Graphics 33(4), 2014; Communications of
//!   the ACM 60(8), 2017.
//! * **Ray-reps**: J. Wu, L. Kramer, R. Westermann, "Shape interior modeling and mass property
//!   optimization using ray-reps", Computers & Graphics 58, 2016.
//! * **Make It Stand**: R. Prévost, E. Whiting, S. Lefebvre, O. Sorkine-Hornung, "Make It Stand:
//!   Balancing Shapes for 3D Fabrication", ACM Transactions on Graphics 32(4), 2013.
//! * **Balance quality**: ISO 21940-11:2016, "Mechanical vibration: Rotor balancing. Part 11:
//!   Procedures and tolerances for rotors with rigid behaviour".
//! * **Dinkelbach**: W. Dinkelbach, "On nonlinear fractional programming", Management Science
//!   13(7), 1967.
//! * **Coarse models mended** (the solver's search on a few columns): D. Echeverría, P. W. Hemker,
//!   "Space mapping and defect correction", Computational Methods in Applied Mathematics 5, 2005;
//!   I. Olkin, F. Pukelsheim, "The distance between two random vectors with given dispersion
//!   matrices", Linear Algebra and its Applications 48, 1982.
//! * **Augmented Lagrangian** (the papers' methods): M. R. Hestenes, "Multiplier and gradient
//!   methods", Journal of Optimization Theory and Applications 4, 1969.
//! * **Projected quasi-Newton**: J. Nocedal, "Updating quasi-Newton matrices with limited storage",
//!   Mathematics of Computation 35, 1980; D. P. Bertsekas, "Projected Newton methods for
//!   optimization problems with simple constraints", SIAM Journal on Control and Optimization 20,
//!   1982; R. H. Byrd, P. Lu, J. Nocedal, C. Zhu, "A limited memory algorithm for bound constrained
//!   optimization", SIAM Journal on Scientific Computing 16, 1995.
//! * **Tetrahedron tensor**: F. Tonon, "Explicit exact formulas for the 3-D tetrahedron inertia
//!   tensor in terms of its vertex coordinates", Journal of Mathematics and Statistics 1(1), 2005.
//! * **Recovered gradients** (the error of sampled densities): O. C. Zienkiewicz, J. Z. Zhu, "A
//!   simple error estimator and adaptive procedure for practical engineering analysis",
//!   International Journal for Numerical Methods in Engineering 24, 1987.
//! * **Density**: D. R. Bukenberger, H. P. A. Lensch, "Tetrahedra of Varying Density and Their
//!   Applications", The Visual Computer 37, 2021.
//! * **Cells under L∞**: the same, §3.3; D. R. Bukenberger, K. Buchin, M. Botsch, "Constructing L∞
//!   Voronoi Diagrams in 2D and 3D", Computer Graphics Forum 41(5) (SGP 2022).
//! * **Lloyd's method**: S. P. Lloyd, "Least squares quantization in PCM", IEEE Transactions on
//!   Information Theory 28(2), 1982.
//! * **Poisson discs**: R. L. Cook, "Stochastic sampling in computer graphics", ACM Transactions on
//!   Graphics 5(1), 1986.
//! * **Fits of fields**: K. Levenberg, "A method for the solution of certain non-linear problems in
//!   least squares", Quarterly of Applied Mathematics 2, 1944; D. W. Marquardt, "An algorithm for
//!   least-squares estimation of nonlinear parameters", J. SIAM 11, 1963; M. J. D. Powell, "An
//!   efficient method for finding the minimum of a function of several variables without
//!   calculating derivatives", The Computer Journal 7, 1964.
//! * **Cone rules and Gauss–Jacobi nodes**: A. H. Stroud, "Approximate Calculation of Multiple
//!   Integrals", Prentice-Hall, 1971; G. H. Golub, J. H. Welsch, "Calculation of Gauss Quadrature
//!   Rules", Mathematics of Computation 23, 1969.
//! * **Compensated sums**: A. Neumaier, "Rundungsfehleranalyse einiger Verfahren zur Summation
//!   endlicher Summen", Zeitschrift für Angewandte Mathematik und Mechanik 54, 1974.
//! * **Winding numbers**: A. Jacobson, L. Kavan, O. Sorkine-Hornung, "Robust inside-outside
//!   segmentation using generalized winding numbers", ACM Transactions on Graphics 32(4), 2013;
//!   G. Barill, N. G. Dickson, R. Schmidt, D. I. W. Levin, A. Jacobson, "Fast winding numbers for
//!   soups and clouds", ACM Transactions on Graphics 37(4), 2018.
//! * **Signed distance**: J. A. Bærentzen, H. Aanæs, "Signed distance computation using the angle
//!   weighted pseudonormal", IEEE Transactions on Visualization and Computer Graphics 11(3), 2005.
//! * **Isosurface stuffing** (the graded tetrahedral lattice): F. Labelle, J. R. Shewchuk,
//!   "Isosurface stuffing: fast tetrahedral meshes with good dihedral angles", ACM Transactions on
//!   Graphics 26(3), 2007.
//! * **Skeletons**: A. Tagliasacchi, I. Alhashim, M. Olson, H. Zhang, "Mean Curvature Skeletons",
//!   Computer Graphics Forum 31(5), 2012; M. Botsch, L. Kobbelt, "A Remeshing Approach to
//!   Multiresolution Modeling", SGP 2004; J. Ma, S. W. Bae, S. Choi, "3D medial axis point
//!   approximation using nearest neighbors and the normal field", The Visual Computer 28, 2012.
//! * **CofiFab** (objects on a laser-cut base): P. Song, B. Deng, Z. Wang, Z. Dong, W. Li, C.-W.
//!   Fu, L. Liu, "CofiFab: coarse-to-fine fabrication of large 3D objects", ACM Transactions on
//!   Graphics 35(4), 2016, with its supplement.
//! * **Linear programmes in few unknowns**: R. Seidel, "Small-dimensional linear programming and
//!   convex hulls made easy", Discrete & Computational Geometry 6, 1991.
//! * **Nesting of convex outlines**: E. K. Burke, R. S. R. Hellier, G. Kendall, G. Whitwell, "A new
//!   bottom-left-fill heuristic algorithm for the two-dimensional irregular packing problem",
//!   Operations Research 54(3), 2006.
//! * **Sparse factors**: A. George, "Nested dissection of a regular finite element mesh", SIAM
//!   Journal on Numerical Analysis 10, 1973; T. A. Davis, "Algorithm 849: a concise sparse Cholesky
//!   factorization package", ACM Transactions on Mathematical Software 31, 2005.
//! * **Closest points**: C. Ericson, "Real-Time Collision Detection", Morgan Kaufmann, 2005,
//!   chapter 5.

! Flow above a disk that rotates with speed 1, below a fluid that rotates with speed s
! (von Karman, Batchelor), cut off at z = L = 10:
!
!     F'' = F^2 - G^2 + H F' + s^2,   G'' = 2 F G + H G',   H' = -2 F   on (0, L),
!     F(0) = 0, G(0) = 1, H(0) = 0, F(L) = 0, G(L) = s,
!
! from s = 1, where F = 0, G = 1, H = 0 is exact, towards smaller s.
! U = (F, F', G, G', H) with ' = d/dz, PAR = (s); the mesh is of x = z / L in (0, 1).

SUBROUTINE FUNC(NDIM, U, ICP, PAR, IJAC, F, DFDU, DFDP)
  IMPLICIT NONE
  INTEGER, INTENT(IN) :: NDIM, ICP(*), IJAC
  DOUBLE PRECISION, INTENT(IN) :: U(NDIM), PAR(*)
  DOUBLE PRECISION, INTENT(OUT) :: F(NDIM)
  DOUBLE PRECISION, INTENT(INOUT) :: DFDU(NDIM, NDIM), DFDP(NDIM, *)
  DOUBLE PRECISION, PARAMETER :: L = 10
  F(1) = L * U(2)
  F(2) = L * (U(1)**2 - U(3)**2 + U(5) * U(2) + PAR(1)**2)
  F(3) = L * U(4)
  F(4) = L * (2 * U(1) * U(3) + U(5) * U(4))
  F(5) = -2 * L * U(1)
  IF (IJAC == 0) RETURN
  DFDU = 0
  DFDU(1, 2) = L
  DFDU(2, 1) = 2 * L * U(1)
  DFDU(2, 2) = L * U(5)
  DFDU(2, 3) = -2 * L * U(3)
  DFDU(2, 5) = L * U(2)
  DFDU(3, 4) = L
  DFDU(4, 1) = 2 * L * U(3)
  DFDU(4, 3) = 2 * L * U(1)
  DFDU(4, 4) = L * U(5)
  DFDU(4, 5) = L * U(4)
  DFDU(5, 1) = -2 * L
  IF (IJAC == 1) RETURN
  DFDP(:, 1) = 0
  DFDP(2, 1) = 2 * L * PAR(1)
END SUBROUTINE FUNC

SUBROUTINE STPNT(NDIM, U, PAR, X)
  IMPLICIT NONE
  INTEGER, INTENT(IN) :: NDIM
  DOUBLE PRECISION, INTENT(INOUT) :: U(NDIM), PAR(*)
  DOUBLE PRECISION, INTENT(IN) :: X
  PAR(1) = 1
  U = 0
  U(3) = 1
END SUBROUTINE STPNT

SUBROUTINE BCND(NDIM, PAR, ICP, NBC, U0, U1, FB, IJAC, DBC)
  IMPLICIT NONE
  INTEGER, INTENT(IN) :: NDIM, ICP(*), NBC, IJAC
  DOUBLE PRECISION, INTENT(IN) :: PAR(*), U0(NDIM), U1(NDIM)
  DOUBLE PRECISION, INTENT(OUT) :: FB(NBC)
  DOUBLE PRECISION, INTENT(INOUT) :: DBC(NBC, *)
  FB(1) = U0(1)
  FB(2) = U0(3) - 1
  FB(3) = U0(5)
  FB(4) = U1(1)
  FB(5) = U1(3) - PAR(1)
  IF (IJAC == 0) RETURN
  DBC(:, 1:2 * NDIM + 1) = 0
  DBC(1, 1) = 1
  DBC(2, 3) = 1
  DBC(3, 5) = 1
  DBC(4, NDIM + 1) = 1
  DBC(5, NDIM + 3) = 1
  DBC(5, 2 * NDIM + 1) = -1
END SUBROUTINE BCND

SUBROUTINE ICND
END SUBROUTINE ICND

SUBROUTINE FOPT
END SUBROUTINE FOPT

SUBROUTINE PVLS
END SUBROUTINE PVLS

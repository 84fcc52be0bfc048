! m weakly coupled Bratu problems, i = 1 .. m in a ring, NDIM = 2 m:
!
!     u_i'' + lambda (1 + 0.01 i / m) exp(u_i) + c (u_{i+1} - 2 u_i + u_{i-1}) = 0 on (0, 1),
!     u_i(0) = u_i(1) = 0,   c = 0.01,   u_0 = u_m, u_{m+1} = u_1,
!
! from lambda = 0, u = 0. U = (u_1, .., u_m, u_1', .., u_m'), PAR = (lambda).

SUBROUTINE FUNC(NDIM, U, ICP, PAR, IJAC, F, DFDU, DFDP)
  IMPLICIT NONE
  INTEGER, INTENT(IN) :: NDIM, ICP(*), IJAC
  DOUBLE PRECISION, INTENT(IN) :: U(NDIM), PAR(*)
  DOUBLE PRECISION, INTENT(OUT) :: F(NDIM)
  DOUBLE PRECISION, INTENT(INOUT) :: DFDU(NDIM, NDIM), DFDP(NDIM, *)
  DOUBLE PRECISION, PARAMETER :: C = 0.01D0
  DOUBLE PRECISION :: E(NDIM / 2)
  INTEGER :: M, I, J
  M = NDIM / 2
  DO I = 1, M
    E(I) = (1 + 0.01D0 * I / M) * EXP(U(I))
  END DO
  F(1:M) = U(M+1:NDIM)
  F(M+1:NDIM) = -PAR(1) * E - C * (CSHIFT(U(1:M), 1) - 2 * U(1:M) + CSHIFT(U(1:M), -1))
  IF (IJAC == 0) RETURN
  DFDU = 0
  DO I = 1, M
    DFDU(I, M+I) = 1
    DFDU(M+I, I) = -PAR(1) * E(I) + 2 * C
    J = 1 + MOD(I, M) ! the neighbour above; for m = 2 also the one below
    DFDU(M+I, J) = DFDU(M+I, J) - C
    J = 1 + MOD(I + M - 2, M)
    DFDU(M+I, J) = DFDU(M+I, J) - C
  END DO
  IF (IJAC == 1) RETURN
  DFDP(1:M, 1) = 0
  DFDP(M+1:NDIM, 1) = -E
END SUBROUTINE FUNC

SUBROUTINE STPNT(NDIM, U, PAR, X)
  IMPLICIT NONE
  INTEGER, INTENT(IN) :: NDIM
  DOUBLE PRECISION, INTENT(INOUT) :: U(NDIM), PAR(*)
  DOUBLE PRECISION, INTENT(IN) :: X
  PAR(1) = 0
  U = 0
END SUBROUTINE STPNT

SUBROUTINE BCND(NDIM, PAR, ICP, NBC, U0, U1, FB, IJAC, DBC)
  IMPLICIT NONE
  INTEGER, INTENT(IN) :: NDIM, ICP(*), NBC, IJAC
  DOUBLE PRECISION, INTENT(IN) :: PAR(*), U0(NDIM), U1(NDIM)
  DOUBLE PRECISION, INTENT(OUT) :: FB(NBC)
  DOUBLE PRECISION, INTENT(INOUT) :: DBC(NBC, *)
  INTEGER :: M, I
  M = NDIM / 2
  FB(1:M) = U0(1:M)
  FB(M+1:NBC) = U1(1:M)
  IF (IJAC == 0) RETURN
  DBC(:, 1:2 * NDIM + 1) = 0
  DO I = 1, M
    DBC(I, I) = 1
    DBC(M+I, NDIM+I) = 1
  END DO
END SUBROUTINE BCND

SUBROUTINE ICND
END SUBROUTINE ICND

SUBROUTINE FOPT
END SUBROUTINE FOPT

SUBROUTINE PVLS
END SUBROUTINE PVLS
